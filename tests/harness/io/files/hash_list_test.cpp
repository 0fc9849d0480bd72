// Lists of hashes are those of coreutils' sha256sum.
#include "harness/io/files/hash_list.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "harness/io/files/atomic_file.hpp"
#include "tests/support/inputs.hpp"

namespace scanbench::io {
namespace {

using testing::HasSubstr;

const std::string kHash(64, 'a');

/// Files with the names that sha256sum writes in different ways.
void write_odd_names(const support::TemporaryFolder& folder) {
  for (const char* name : {"plain", "two words", "back\\slash", "line\nend", "return\r", " blank", "\xc3\xa4", "*star"})
    folder.write(name, std::string("the file ") + name);
}

int shell(const support::TemporaryFolder& folder, const std::string& command) {
  return std::system(("cd '" + folder.path().string() + "' && " + command).c_str());
}

TEST(HashList, IsWhatSha256sumWrites) {
  const support::TemporaryFolder folder, lists;
  write_odd_names(folder);
  const std::string by_coreutils = lists.path() / "by_coreutils";
  ASSERT_EQ(shell(folder, "LC_ALL=C sha256sum -- * > '" + by_coreutils + "'"), 0);
  const std::string lines = hash_lines(folder.path());
  const std::string list = hash_list(parse_hash_list(lines, "lines"));
  EXPECT_EQ(list, read_file(by_coreutils));
  EXPECT_EQ(list.size(), lines.size());
}

TEST(HashList, IsCheckedBySha256sum) {
  const support::TemporaryFolder folder, lists;
  write_odd_names(folder);
  const auto list = lists.write("list", hash_list(parse_hash_list(hash_lines(folder.path()), "lines")));
  const std::string check = "sha256sum --check --strict --status '" + list.string() + "'";
  EXPECT_EQ(shell(folder, check), 0);
  folder.write("line\nend", "changed");
  EXPECT_NE(shell(folder, check), 0);
}

TEST(HashList, ReadsTheLastLineOfAPathInAnyOrder) {
  const std::string other(64, 'b');
  const FileHashes hashes =
      parse_hash_list(hash_line("b/c", kHash) + hash_line("a", kHash) + hash_line("b/c", other), "list");
  EXPECT_EQ(hashes, (FileHashes{{"a", kHash}, {"b/c", other}}));
  EXPECT_EQ(hash_list(hashes), kHash + "  a\n" + other + "  b/c\n");
  EXPECT_TRUE(parse_hash_list("", "list").empty());
}

TEST(HashList, RefusesOtherLinesWithTheirPlace) {
  const std::string good = hash_line("a", kHash);
  for (const std::string& bad : {std::string("\n"), std::string("a\n"), kHash, kHash + "  \n", kHash + " a\n",
                                 kHash + "a  a\n", std::string(64, 'A') + "  a\n", "\\" + kHash + "  a\\x\n",
                                 "\\" + kHash + "  a\\\n", std::string(64, 'g') + "  a\n"})
    EXPECT_THAT(support::config_refusal([&] { parse_hash_list(good + bad, "the.list"); }),
                HasSubstr("the.list:2: not a line of sha256sum"))
        << bad;
}

}  // namespace
}  // namespace scanbench::io
