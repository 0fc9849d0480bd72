// The version that a program states: a changed tree is not its commit.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "tests/app/program.hpp"

namespace scanbench::app_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

TEST(Version, NamesACommitAndMarksAChangedTree) {
  EXPECT_THAT(run({"--version"}).out, testing::MatchesRegex("scanbench [0-9.]+ \\(.*([0-9a-f]{12}|unknown).*\\)\n"));
}

/// kCommit of the header that is written for a source tree.
std::string stated_commit(const Folder& folder) {
  const std::string command = "cmake -DSOURCE_DIR=" + (folder / "tree").string() +
                              " -DOUTPUT=" + (folder / "version.hpp").string() + " -P " +
                              (places::source_dir() / "cmake/write_version.cmake").string() + " 2>&1";
  EXPECT_EQ(std::system(command.c_str()), 0);
  const std::string text = read(folder / "version.hpp");
  const std::string name = "kCommit = \"";
  const auto at = text.find(name);
  if (at == std::string::npos) return "";
  return text.substr(at + name.size(), text.find('"', at + name.size()) - at - name.size());
}

TEST(Version, OfAChangedTreeHasAHashOfItsCode) {
  const Folder folder;
  folder.write("tree/core/a.cpp", "int a;\n");
  folder.write("tree/notes.txt", "notes\n");
  const std::string git = "cd " + (folder / "tree").string() +
                          " && git init -q && git add . && git -c user.name=a -c user.email=a@b commit -q -m first";
  ASSERT_EQ(std::system(git.c_str()), 0);
  const std::string clean = stated_commit(folder);
  EXPECT_EQ(clean.size(), 40U) << clean;

  folder.write("tree/notes.txt", "other notes\n");
  EXPECT_EQ(stated_commit(folder), clean);
  folder.write("tree/core/a.cpp", "int b;\n");
  const std::string changed = stated_commit(folder);
  EXPECT_THAT(changed, testing::StartsWith(clean + "-dirty-"));
  folder.write("tree/core/a.cpp", "int c;\n");
  const std::string changed_again = stated_commit(folder);
  EXPECT_THAT(changed_again, AllOf(HasSubstr("-dirty-"), Not(testing::Eq(changed))));
  folder.write("tree/core/a.cpp", "int b;\n");
  EXPECT_EQ(stated_commit(folder), changed);
  folder.write("tree/core/a.cpp", "int a;\n");
  folder.write("tree/core/new.hpp", "int n;\n");  // not added to git, but compiled
  EXPECT_THAT(stated_commit(folder), HasSubstr("-dirty-"));
}

TEST(Version, StaysWhereACommitChangesNoCode) {
  const Folder folder;
  folder.write("tree/core/a.cpp", "int a;\n");
  const std::string go = "cd " + (folder / "tree").string() + " && ";
  const std::string commit = "git add . && git -c user.name=a -c user.email=a@b commit -q -m next";
  ASSERT_EQ(std::system((go + "git init -q && " + commit).c_str()), 0);
  const std::string first = stated_commit(folder);
  const auto written = fs::last_write_time(folder / "version.hpp");
  folder.write("tree/baselines/nightly/0001.json", "{}\n");
  ASSERT_EQ(std::system((go + commit).c_str()), 0);
  EXPECT_EQ(stated_commit(folder), first);
  EXPECT_EQ(fs::last_write_time(folder / "version.hpp"), written);  // nothing is compiled or linked again
  folder.write("tree/core/a.cpp", "int b;\n");
  ASSERT_EQ(std::system((go + commit).c_str()), 0);
  EXPECT_NE(stated_commit(folder), first);
  EXPECT_EQ(stated_commit(folder).size(), 40U);
}

}  // namespace
}  // namespace scanbench::app_test
