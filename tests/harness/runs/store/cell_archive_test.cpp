// Archives of cells: what was added is read back, and what could not be added leaves nothing.
#include "harness/runs/store/cell_archive.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <cstdint>
#include <filesystem>
#include <string>

#include <sys/resource.h>

#include "harness/io/files/atomic_file.hpp"
#include "harness/io/files/system_error.hpp"
#include "tests/support/inputs.hpp"
#include "tests/support/runs.hpp"

namespace scanbench::runs {
namespace {

using ::testing::HasSubstr;

const FolderFiles kSmall{{"lines.csv", "frame\n0\n"}, {"labels.npy", std::string("\0\1\0", 3)}};

TEST(CellArchive, FoldersAreReadBackByTheirPart) {
  const support::TemporaryFolder folder;
  ArchiveWriter writer(folder.path() / "a.tar");
  const FolderFiles large{{"ranges.npy", std::string(100000, 'r')}};
  const ArchivePart first = writer.add("cells/room/iepf/1", kSmall);
  const ArchivePart second = writer.add("recordings/room/1", large);
  const std::string hash = writer.finish();
  EXPECT_EQ(hash, io::sha256_of_file(folder.path() / "a.tar"));
  const ArchiveReader reader(folder.path() / "a.tar");
  EXPECT_EQ(reader.files(first, "cells/room/iepf/1"), kSmall);
  EXPECT_EQ(reader.files(second, "recordings/room/1"), large);
  EXPECT_TRUE(reader.is_whole(first));
  EXPECT_THAT(support::config_refusal([&] { reader.files(first, "cells/room/iepf/2"); }),
              HasSubstr("is called cells/room/iepf/1"));
}

TEST(CellArchive, AFolderOfMoreBytesThanAllowedIsNotRead) {
  const support::TemporaryFolder folder;
  for (const std::string name : {"a.csv", "b.csv"})
    std::filesystem::resize_file(folder.write(name, ""), std::uint64_t{200} << 30);  // it has no blocks on the disk
  EXPECT_THAT(support::config_refusal([&] { read_folder(folder.path()); }),
              HasSubstr("have 400 GiB; allowed in an archive: 2 GiB"));
  std::filesystem::resize_file(folder.path() / "a.csv", 3);
  std::filesystem::resize_file(folder.path() / "b.csv", 4);
  EXPECT_EQ(read_folder(folder.path(), 7).size(), 2u);
  EXPECT_THROW(read_folder(folder.path(), 6), ConfigError);
}

TEST(CellArchive, FilesThatWereNotDeclaredAreLeftOutAndChangedOnesRefused) {
  const support::TemporaryFolder folder;
  folder.write("lines.csv", "abc");
  folder.write("planted.csv", "not declared");
  // SHA-256 of "abc": FIPS 180-4, its first example.
  const std::string abc = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
  EXPECT_EQ(read_files(folder.path(), {{"lines.csv", abc}}), (FolderFiles{{"lines.csv", "abc"}}));
  folder.write("lines.csv", "abd");
  EXPECT_THAT(support::config_refusal([&] {
                read_files(folder.path(), {{"lines.csv", abc}});
              }),
              HasSubstr("lines.csv has changed since it was written"));
}

TEST(CellArchive, AFolderThatDoesNotFitTheDiskLeavesTheArchiveAsItWas) {
  const support::TemporaryFolder folder;
  ArchiveWriter writer(folder.path() / "a.tar");
  const ArchivePart first = writer.add("cells/room/iepf/1", kSmall);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, SIG_IGN);
  const rlimit limit{5000, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &limit);
  EXPECT_THROW(writer.add("cells/room/iepf/2", {{"large", std::string(20000, 'x')}}), io::SystemError);
  setrlimit(RLIMIT_FSIZE, &before);
  const ArchivePart third = writer.add("cells/room/iepf/3", kSmall);
  EXPECT_EQ(third.offset, first.offset + first.bytes);
  const std::string hash = writer.finish();
  EXPECT_EQ(hash, io::sha256_of_file(folder.path() / "a.tar"));
  EXPECT_EQ(ArchiveReader(folder.path() / "a.tar").files(third, "cells/room/iepf/3"), kSmall);
}

TEST(CellArchive, PartsBeyondTheEndAreNotWhole) {
  const support::TemporaryFolder folder;
  ArchiveWriter writer(folder.path() / "a.tar");
  ArchivePart part = writer.add("cells/room/iepf/1", kSmall);
  writer.finish();
  const ArchiveReader reader(folder.path() / "a.tar");
  for (const std::uint64_t offset : {std::uint64_t{100000}, ~std::uint64_t{0}}) {
    part.offset = offset;
    EXPECT_FALSE(reader.is_whole(part));
    EXPECT_THAT(support::config_refusal([&] { reader.files(part, "cells/room/iepf/1"); }), HasSubstr("cut off"));
  }
}

}  // namespace
}  // namespace scanbench::runs
