// SHA-256, and atomic replacement of files: full disks, killed writers, special files.
#include "harness/io/files/atomic_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/error.hpp"
#include "harness/io/files/descriptor.hpp"
#include "harness/io/files/hash.hpp"
#include "harness/runs/execute/worker.hpp"
#include "tests/support/runs.hpp"

namespace scanbench::io {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(Sha256, AgreesWithTheExamplesOfFips180) {
  EXPECT_EQ(sha256_hex("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256_hex(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_NE(Sha256().part("a", "bc").hex(), Sha256().part("ab", "c").hex());
}

TEST(AtomicFile, ReplacesTheWholeFileAndLeavesNothingElse) {
  const support::TemporaryFolder folder;
  write_file_atomically(folder.path() / "f", "long content");
  write_file_atomically(folder.path() / "f", "new");
  EXPECT_EQ(read_file(folder.path() / "f"), "new");
  EXPECT_THAT(fixtures::listing(folder.path()), ElementsAre("f"));
}

TEST(AtomicFile, ReadsFilesWhoseSizeTheSystemDoesNotSay) {
  EXPECT_THAT(read_file("/proc/self/status"), HasSubstr("VmRSS"));
  EXPECT_THROW(read_file("/proc"), ConfigError);
  EXPECT_THROW(read_file("/nowhere/f"), ConfigError);
}

TEST(AtomicFile, WithoutRoomTheOldFileStaysAndTheReasonIsNamed) {
  const support::TemporaryFolder folder;
  const fs::path file = folder.path() / "f";
  write_file_atomically(file, "old");
  runs::WorkerPool pool;  // a child, so that the limit does not affect the other tests
  pool.start(0,
             [&]() -> std::string {
               const rlimit limit{1000, 1000};
               setrlimit(RLIMIT_FSIZE, &limit);
               try {
                 write_file_atomically(file, std::string(5000, 'x'));
               } catch (const ConfigError& e) {
                 return e.what();
               }
               return "written";
             },
             {});
  const auto finished = pool.wait();
  ASSERT_EQ(finished.size(), 1u);
  EXPECT_EQ(finished[0].outcome.message, "cannot write " + file.string() + ": File too large");
  EXPECT_EQ(read_file(file), "old");
  EXPECT_THAT(fixtures::listing(folder.path()), ElementsAre("f"));
}

TEST(AtomicFile, NamesAFullDiskAndAMissingFolder) {
  const auto message = [](const fs::path& path, auto write) -> std::string {
    try {
      write(path, "text");
    } catch (const ConfigError& e) {
      return e.what();
    }
    return "written";
  };
  EXPECT_EQ(message("/dev/full", write_staged_file), "cannot write /dev/full: No space left on device");
  EXPECT_EQ(message("/nowhere/f", write_file_atomically), "cannot write /nowhere/f: No such file or directory");
}

TEST(AtomicFile, AKilledWriterLeavesTheOldOrTheNewFileWhole) {
  const support::TemporaryFolder folder;
  const fs::path file = folder.path() / "f";
  const std::string a(1 << 20, 'a');
  const std::string b(1 << 20, 'b');
  write_file_atomically(file, a);
  for (int round = 0; round < 12; ++round) {
    const pid_t child = ::fork();
    if (child == 0) {
      while (true) {
        write_file_atomically(file, b);
        write_file_atomically(file, a);
      }
    }
    ::usleep(static_cast<useconds_t>(1000 + 1700 * round));
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    const std::string found = read_file(file);
    EXPECT_TRUE(found == a || found == b) << found.size();
  }
  for (const auto& name : fixtures::listing(folder.path())) EXPECT_TRUE(name == "f" || is_temporary_name(name)) << name;
}

TEST(StagedFolder, AppearsAsAWholeOrNotAtAll) {
  const support::TemporaryFolder folder;
  const fs::path target = folder.path() / "deep" / "cell";
  {
    StagedFolder staged(target);
    write_staged_file(staged.path() / "x", "1");
    EXPECT_FALSE(fs::exists(target));
  }
  EXPECT_THAT(fixtures::listing(folder.path()), ElementsAre("deep"));
  for (const char* content : {"1", "2"}) {
    StagedFolder staged(target);
    write_staged_file(staged.path() / content, content);
    staged.commit();
    EXPECT_THAT(fixtures::listing(folder.path()),
                ElementsAre("deep", "deep/cell", "deep/cell/" + std::string(content)));
  }
}

TEST(ExchangeFolders, SwapsTwoFolders) {
  for (const auto exchange : {exchange_folders, exchange_folders_in_steps}) {
    const support::TemporaryFolder folder;
    make_folders(folder.path() / "a" / "in a");
    make_folders(folder.path() / "b" / "in b");
    exchange(folder.path() / "a", folder.path() / "b");
    EXPECT_THAT(fixtures::listing(folder.path()), ElementsAre("a", "a/in b", "b", "b/in a"));
  }
}

TEST(ExchangeFolders, WhatAKilledOneLeftAsideIsPutBack) {
  const support::TemporaryFolder folder;
  make_folders(folder.path() / ".run.tmp-12-aside" / "old");
  make_folders(folder.path() / ".run.tmp-12" / "new");
  make_folders(folder.path() / ".run.tmp-mine");
  make_folders(folder.path() / "run");
  EXPECT_TRUE(put_back(folder.path() / "run")) << "an empty folder is nothing";
  EXPECT_FALSE(put_back(folder.path() / "run"));
  remove_unfinished_folders(folder.path() / "run");
  EXPECT_THAT(fixtures::listing(folder.path()), ElementsAre(".run.tmp-mine", "run", "run/old"));
}

TEST(ExchangeFolders, WhatIsAsideOfAFolderWithFilesIsNotPutBack) {
  const support::TemporaryFolder folder;
  make_folders(folder.path() / ".run.tmp-12-aside" / "old");
  make_folders(folder.path() / "run" / "new");
  EXPECT_FALSE(put_back(folder.path() / "run"));
  remove_unfinished_folders(folder.path() / "run");
  EXPECT_THAT(fixtures::listing(folder.path()), ElementsAre("run", "run/new"));
}

TEST(AtomicFile, ANewFileReplacesNone) {
  const support::TemporaryFolder folder;
  EXPECT_TRUE(write_new_file(folder.path() / "f", "first"));
  EXPECT_FALSE(write_new_file(folder.path() / "f", "second"));
  EXPECT_EQ(read_file(folder.path() / "f"), "first");
  EXPECT_THAT(fixtures::listing(folder.path()), ElementsAre("f"));
}

}  // namespace
}  // namespace scanbench::io
