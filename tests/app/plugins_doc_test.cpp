// docs/plugins.md, followed from its first command to its last, as it is written.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/app/page_blocks.hpp"

namespace scanbench::app_test {
namespace {

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
  folder.write("mine/walls.py", page_blocks(text, "python").at(0));
  folder.write("mine/room.yaml", page_blocks(text, "yaml").at(0));
  EXPECT_GE(run_commands_of_page(text, folder), 12);
  EXPECT_THAT(read(folder / "examples/plugin/CMakeLists.txt"), testing::HasSubstr(page_blocks(text, "cmake").at(0)));
  EXPECT_TRUE(fs::exists(folder / "out/library/report.html"));
}

}  // namespace
}  // namespace scanbench::app_test
