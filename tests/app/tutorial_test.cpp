// docs/tutorial.md, followed from its first command to its last, as it is written.
#include <gtest/gtest.h>

#include "tests/app/page_blocks.hpp"

namespace scanbench::app_test {
namespace {

TEST(Tutorial, LeadsFromALogToAFigureAsWritten) {
  const Folder folder;
  const std::string text = read(places::source_dir() / "docs/tutorial.md");
  fs::create_symlink(places::program(), folder / "scanbench");
  fs::create_directory_symlink(places::source_dir() / "scenarios", folder / "scenarios");
  for (const std::string& block : page_blocks(text, "yaml"))  // its first line is "# NAME.yaml"
    folder.write(block.substr(2, block.find('\n') - 2), block);
  EXPECT_GE(run_commands_of_page(text, folder), 12);
  EXPECT_TRUE(fs::exists(folder / "out/lines/scans.html"));
  EXPECT_TRUE(fs::exists(folder / "paper/truth_seeds.pdf"));
  EXPECT_TRUE(fs::exists(folder / "paper/truth_seeds.caption.txt"));
}

}  // namespace
}  // namespace scanbench::app_test
