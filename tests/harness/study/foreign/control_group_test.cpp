// Folders of control groups, in trees of files like those of Linux (Documentation/admin-guide/cgroup-v1 and cgroup-v2).
#include "harness/study/foreign/control_group.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <string>

#include "harness/io/files/atomic_file.hpp"
#include "tests/support/temporary_folder.hpp"

namespace scanbench::study {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::IsEmpty;

class ControlGroups : public testing::Test {
 protected:
  void write(const fs::path& file, const std::string& text) const {
    fs::create_directories((root() / file).parent_path());
    std::ofstream(root() / file) << text;
  }
  std::string text(const fs::path& file) const { return io::read_file(root() / file); }
  /// A group of version 2. Its controllers are handed down if it names them.
  void group(const fs::path& path, const std::string& handed_down, const std::string& memory = "max") const {
    write(path / "cgroup.procs", "");
    write(path / "cgroup.controllers", "cpu memory pids\n");
    write(path / "cgroup.subtree_control", handed_down + "\n");
    if (!path.empty()) write(path / "memory.max", memory + "\n");
  }
  fs::path root() const { return folder_.path(); }
  support::TemporaryFolder folder_;
};

TEST_F(ControlGroups, OfVersion2AreMadeInTheNearestGroupThatHandsItsControllersDown) {
  group("", "memory pids");
  group("user", "cpu memory pids");
  group("user/terminal", "");
  const GroupFolders folders = group_folders(root(), "0::/user/terminal\n");
  EXPECT_EQ(folders.memory, root() / "user");
  EXPECT_EQ(folders.processes, root() / "user");
  EXPECT_THAT(group_limits(folders), ElementsAre("cgroup memory.max", "cgroup pids.max"));
}

TEST_F(ControlGroups, OfVersion2AreNotMadeWhereTheProcessWouldLeaveALimit) {
  group("", "memory pids");
  group("job", "", "1000000");
  EXPECT_THAT(group_limits(group_folders(root(), "0::/job\n")), IsEmpty());
}

TEST_F(ControlGroups, OfVersion2NeedBothControllers) {
  group("", "memory");
  EXPECT_THAT(group_limits(group_folders(root(), "0::/\n")), IsEmpty());
}

TEST_F(ControlGroups, OfVersion1AreMadeInTheOwnGroupOfEachController) {
  write("memory/job/cgroup.procs", "");
  write("pids/cgroup.procs", "");
  const std::string own = "3:cpu,cpuacct:/\n2:memory:/job\n1:pids:/docker/not-visible-here\n0::/\n";
  const GroupFolders folders = group_folders(root(), own);
  EXPECT_EQ(folders.memory, root() / "memory/job");
  EXPECT_EQ(folders.processes, root() / "pids");
  EXPECT_THAT(group_limits(folders), ElementsAre("cgroup memory.limit_in_bytes", "cgroup pids.max"));
}

TEST_F(ControlGroups, AreNotMadeWhereThereAreNone) {
  EXPECT_THAT(group_limits(group_folders(root() / "nothing", "0::/\n")), IsEmpty());
  EXPECT_THAT(group_limits(group_folders(root(), "")), IsEmpty());
}

TEST_F(ControlGroups, HoldTheProcessAndItsLimits) {
  const fs::path own = "scanbench-" + std::to_string(getpid());
  for (const char* file : {"memory.max", "pids.max", "cgroup.procs", "memory.oom.group"}) write(own / file, "");
  enter_groups({root(), root()}, 5e9, 64);
  EXPECT_EQ(text(own / "memory.max"), "5000000000");
  EXPECT_EQ(text(own / "pids.max"), "64");
  EXPECT_EQ(text(own / "memory.oom.group"), "1");
  EXPECT_EQ(text(own / "cgroup.procs"), std::to_string(getpid()));
  EXPECT_FALSE(fs::exists(root() / own / "memory.swap.max")) << "only the system makes these files";
}

}  // namespace
}  // namespace scanbench::study
