// Hashes of files without a text that is written in them.
#include "harness/io/files/hash.hpp"

#include <gtest/gtest.h>

#include <string>

#include "harness/io/files/atomic_file.hpp"
#include "tests/support/runs.hpp"

namespace scanbench::io {
namespace {

TEST(Hash, WithoutATextDependsOnAllOtherBytes) {
  const support::TemporaryFolder folder;
  const auto hash = [&](const std::string& bytes, const std::string& text) {
    write_file_atomically(folder.path() / "file", bytes);
    return sha256_of_file_without(folder.path() / "file", text);
  };
  const std::string one(40, 'a');
  const std::string two = "0123456789012345678901234567890123456789";
  const std::string before(65536 - 20, 'x');  // the text crosses the end of a block
  const auto file = [&](const std::string& text, const std::string& end) { return before + text + "y" + text + end; };
  EXPECT_EQ(hash(file(one, "z"), one), hash(file(two, "z"), two));
  EXPECT_NE(hash(file(one, "z"), one), hash(file(two, "w"), two));
  EXPECT_NE(hash(file(one, "z"), one), hash(file(one, "z"), two));
  EXPECT_NE(hash(before + one, one), hash(before + "b" + one, one));  // its place counts
  EXPECT_EQ(hash(file(one, "z"), ""), sha256_hex(file(one, "z")));
}

}  // namespace
}  // namespace scanbench::io
