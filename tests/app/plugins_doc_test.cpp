// docs/plugins.md, followed from its first command to its last, as it is written.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <sstream>

#include "tests/app/program.hpp"

namespace scanbench::app_test {
namespace {

/// The lines of all blocks in this language.
std::string blocks(const std::string& text, const std::string& language) {
  std::string lines, line;
  std::istringstream in(text);
  for (bool inside = false; std::getline(in, line);) {
    if (line.starts_with("```"))
      inside = line == "```" + language;
    else if (inside)
      lines += line + "\n";
  }
  return lines;
}

TEST(PluginsDoc, EveryCommandWorksAsWritten) {
  if (kSanitized) GTEST_SKIP() << "the package builds without sanitizers, and a library must have them as well";
  if (std::system("python3 -c pass >/dev/null 2>&1") != 0) GTEST_SKIP() << "there is no python3";
  const Folder folder;
  const std::string text = read(places::source_dir() / "docs/plugins.md");
  for (const std::string name : {"clients", "examples"})
    fs::create_directory_symlink(places::source_dir() / name, folder / name);
  fs::create_symlink(places::program(), folder / "scanbench");
  fs::create_directories(folder / "build");
  fs::create_directory_symlink(fs::path(places::program()).parent_path(), folder / "build/release");
  folder.write("mine/walls.py", blocks(text, "python"));
  folder.write("mine/room.yaml", blocks(text, "yaml"));
  std::istringstream commands(blocks(text, "sh"));
  int count = 0;
  for (std::string command; std::getline(commands, command); ++count) {
    const std::string all = "cd " + folder.path().string() + " && " + command + " >log 2>&1";
    ASSERT_EQ(std::system(all.c_str()), 0) << command << "\n" << read(folder / "log");
  }
  EXPECT_GE(count, 12);
  EXPECT_THAT(read(folder / "examples/plugin/CMakeLists.txt"), testing::HasSubstr(blocks(text, "cmake")));
  EXPECT_TRUE(fs::exists(folder / "out/library/report.html"));
}

}  // namespace
}  // namespace scanbench::app_test
