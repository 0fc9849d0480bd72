// Paths that are not regular files, and files that are too large, are refused before they can block a run or fill the
// memory.
#include "harness/io/files/input_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "harness/io/files/atomic_file.hpp"
#include "harness/io/files/hash.hpp"
#include "harness/io/files/text_file.hpp"
#include "tests/support/inputs.hpp"

namespace scanbench::io {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

TEST(InputFile, EveryReaderRefusesWhatIsNoRegularFile) {
  const support::TemporaryFolder folder;
  const fs::path fifo = folder.path() / "fifo";
  ASSERT_EQ(::mkfifo(fifo.c_str(), 0600), 0);
  for (const fs::path& path : {fifo, fs::path("/dev/zero"), folder.path()}) {
    const std::string expected = path.string() + ": not a regular file";
    EXPECT_THAT(support::config_refusal([&] { read_file(path); }), HasSubstr(expected));
    EXPECT_THAT(support::config_refusal([&] { read_text_file(path, 100); }), HasSubstr(expected));
    EXPECT_THAT(support::config_refusal([&] { sha256_of_file(path); }), HasSubstr(expected));
  }
  EXPECT_THAT(support::config_refusal([&] { read_file(folder.path() / "none"); }), HasSubstr("none: no such file"));
}

TEST(InputFile, ATooLargeFileIsRefusedByItsSizeAlone) {
  const support::TemporaryFolder folder;
  const fs::path sparse = folder.write("sparse.log", "");
  fs::resize_file(sparse, std::uintmax_t{20} << 30);
  EXPECT_THAT(support::config_refusal([&] { read_text_file(sparse, 1 << 20); }),
              HasSubstr("sparse.log: larger than 1 MiB (20 GiB)"));
  fs::resize_file(sparse, std::uintmax_t{1} << 42);
  EXPECT_THAT(support::config_refusal([&] { read_file(sparse); }), HasSubstr("sparse.log: larger than "));
}

TEST(InputFile, AGzipBombIsRefusedWithItsName) {
  const support::TemporaryFolder folder;
  const fs::path letters = folder.write("letters.gz", support::gzip(std::string(3 << 20, 'x')));
  EXPECT_THAT(support::config_refusal([&] { read_text_file(letters, 1 << 20); }),
              HasSubstr("letters.gz: larger than 1 MiB when unpacked"));
  const fs::path zeros = folder.write("zeros.gz", support::gzip("a\nbc" + std::string(3 << 20, '\0')));
  EXPECT_THAT(support::config_refusal([&] { read_text_file(zeros, 10 << 20); }), HasSubstr("zeros.gz:2:3: a byte 0"));
}

TEST(InputFile, PlacesAreCountedAcrossBlocks) {
  const support::TemporaryFolder folder;
  std::string text(3000000, 'x');  // several blocks
  text[10] = '\n';
  text += '\0';
  EXPECT_THAT(support::config_refusal([&] { read_text_file(folder.write("f", text), 10 << 20); }),
              HasSubstr("f:2:2999990: a byte 0"));
}

TEST(InputFile, TheHashOfAFileIsThatOfItsBytes) {
  const support::TemporaryFolder folder;
  const std::string bytes(200001, 'q');
  EXPECT_EQ(sha256_of_file(folder.write("f", bytes)), sha256_hex(bytes));
  // FIPS 180-2, appendix B.1.
  EXPECT_EQ(sha256_of_file(folder.write("g", "abc")),
            "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

}  // namespace
}  // namespace scanbench::io
