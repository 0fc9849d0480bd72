// Archives, compared with what the program tar makes of them.
#include "harness/io/files/tar.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "harness/io/files/atomic_file.hpp"
#include "tests/support/inputs.hpp"
#include "tests/support/runs.hpp"

namespace scanbench::io {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

struct File {
  std::string path, bytes;
};

/// Paths that a header has room for, just has room for, and has no room for; sizes about a block of 512 bytes.
std::vector<File> files() {
  const std::string name(100, 'n'), folder(155, 'f'), long_name(180, 'l');
  return {{"cells/room/iepf/7/lines.csv", "a,b\n1,2\n"},
          {"empty", ""},
          {"block", std::string(512, 'x')},
          {"block_and_more", std::string(513, '\0')},
          {name, "100 letters"},
          {folder + "/" + name, "155 and 100 letters"},
          {long_name + "/" + long_name + "/file", "neither part has room"},
          {"zeros/and\xc3\xa9", std::string("\0\0ustar", 7)}};
}

std::string archive_of(const std::vector<File>& all) {
  std::string archive;
  for (const auto& [path, bytes] : all) archive += tar_member(path, bytes);
  return archive;
}

TEST(Tar, TheProgramTarUnpacksEveryFile) {
  const support::TemporaryFolder folder;
  write_file_atomically(folder.path() / "a.tar", archive_of(files()) + tar_end());
  fs::create_directory(folder.path() / "out");
  const std::string command =
      "tar -xf " + (folder.path() / "a.tar").string() + " -C " + (folder.path() / "out").string();
  ASSERT_EQ(std::system(command.c_str()), 0);
  for (const auto& [path, bytes] : files()) EXPECT_EQ(read_file(folder.path() / "out" / path), bytes) << path;
}

TEST(Tar, ReadsWhatTheProgramTarWrites) {
  const support::TemporaryFolder folder;
  fs::create_directories(folder.path() / "in");
  write_file_atomically(folder.path() / "in/one", "first");
  write_file_atomically(folder.path() / "in/two", std::string(2000, 'y'));
  const std::string command = "tar --format=ustar -cf " + (folder.path() / "a.tar").string() + " -C " +
                              (folder.path() / "in").string() + " one two";
  ASSERT_EQ(std::system(command.c_str()), 0);
  const std::string bytes = read_file(folder.path() / "a.tar");
  const auto members = tar_members(bytes, "a.tar");
  ASSERT_EQ(members.size(), 2u);
  EXPECT_EQ(members[0].path, "one");
  EXPECT_EQ(members[0].bytes, "first");
  EXPECT_EQ(members[1].bytes, std::string(2000, 'y'));
}

TEST(Tar, PartsOfAnArchiveAreReadBack) {
  for (const std::string& end : {std::string(), tar_end()}) {
    const std::string archive = archive_of(files()) + end;
    EXPECT_EQ(archive.size() % 512, 0u);
    const auto members = tar_members(archive, "a.tar");
    ASSERT_EQ(members.size(), files().size());
    for (std::size_t i = 0; i < members.size(); ++i) {
      EXPECT_EQ(members[i].path, files()[i].path);
      EXPECT_EQ(members[i].bytes, files()[i].bytes);
    }
  }
}

TEST(Tar, RefusesDamagedArchives) {
  const std::string archive = archive_of(files());
  for (const std::size_t size : {std::size_t{1}, std::size_t{511}, std::size_t{700}, archive.size() - 1})
    EXPECT_THAT(support::config_refusal([&] { tar_members(archive.substr(0, size), "a.tar"); }), HasSubstr("a.tar"))
        << size;
  for (const std::size_t at : {0u, 100u, 124u, 130u, 150u, 156u, 257u, 345u}) {
    std::string changed = archive;
    changed[at] = static_cast<char>(changed[at] ^ 2);
    EXPECT_THAT(support::config_refusal([&] { tar_members(changed, "a.tar"); }), HasSubstr("damaged")) << at;
  }
}

}  // namespace
}  // namespace scanbench::io
