// Accidents of ordinary use: logs on full disks, closed terminals, two verbs in one folder.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/file.h>

#include "tests/app/program.hpp"

namespace scanbench::app_test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// A folder with room.yaml.
class BadLuck : public testing::Test {
 protected:
  void SetUp() override { folder_.write("room.yaml", room()); }
  Outcome here(const Args& args) const { return run(args, {}, folder_.path()); }
  Outcome shell(const std::string& command) const {
    return Child({"/bin/sh", "-c", "\"" + places::program().string() + "\" " + command}, {}, folder_.path()).wait();
  }
  Folder folder_;
};

TEST_F(BadLuck, StandardErrorThatCannotBeWrittenEndsNoRun) {
  ASSERT_EQ(here({"run", "room.yaml", "--out", "good", "-q"}).code, 0);
  for (const std::string redirection : {"2>/dev/full", "2>&-", "<&- 2>&-"}) {
    fs::remove_all(folder_ / "run");
    EXPECT_EQ(shell("run room.yaml --out run " + redirection).code, 0) << redirection;
    EXPECT_THAT(differences(results(folder_ / "good"), results(folder_ / "run")), IsEmpty());
    EXPECT_EQ(shell("run nothing.yaml " + redirection).code, 2) << redirection;
  }
  // A pipe without a reader.
  fs::remove_all(folder_ / "run");
  EXPECT_EQ(shell("run room.yaml --out run 2>&1 >/dev/null | true; test -e run/report.html").code, 0);
}

TEST_F(BadLuck, SimulateDoesNotRemoveTheCellsOfARun) {
  ASSERT_EQ(here({"run", "room.yaml", "-q"}).code, 0);
  const auto before = files(folder_.path());
  const auto outcome = here({"simulate", "room.yaml", "-q"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("--out"));
  EXPECT_THAT(differences(before, files(folder_.path())), IsEmpty());
  EXPECT_EQ(here({"simulate", "room.yaml", "-q", "--out", "alone"}).code, 0);
  EXPECT_EQ(here({"simulate", "room.yaml", "-q", "--out", "alone"}).code, 0);
}

TEST_F(BadLuck, ScoreLeavesCellsOfAWorldFileToResume) {
  ASSERT_EQ(here({"run", abcdef(), "--set", "trajectory.scans=3", "--out", "o", "-q"}).code, 0);
  ASSERT_EQ(here({"score", "o", "-q"}).code, 0);
  const auto outcome = here({"run", abcdef(), "--set", "trajectory.scans=3", "--out", "o", "--resume", "-q", "--json"});
  EXPECT_THAT(outcome.out, HasSubstr("\"reused\": true"));
  EXPECT_THAT(outcome.out, Not(HasSubstr("\"reused\": false")));
}

TEST_F(BadLuck, NothingWritesIntoAFolderThatAnotherProcessHasLocked) {
  ASSERT_EQ(here({"run", "room.yaml", "--out", "run", "-q"}).code, 0);
  const auto before = files(folder_.path());
  const int lock = open((folder_ / "run").c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  ASSERT_EQ(flock(lock, LOCK_EX), 0);
  for (const Args& args :
       {Args{"run", "room.yaml", "--out", "run"}, Args{"run", "room.yaml", "--out", "run", "--resume"},
        Args{"score", "run"}, Args{"figures", "run"}, Args{"report", "run"}}) {
    const auto outcome = here(args);
    EXPECT_EQ(outcome.code, 2) << args[0];
    EXPECT_THAT(outcome.err, HasSubstr("another run is writing")) << args[0];
  }
  EXPECT_THAT(differences(before, files(folder_.path())), IsEmpty());
  close(lock);
  EXPECT_EQ(here({"score", "run", "-q"}).code, 0);
}

TEST_F(BadLuck, FiguresThatTakeTooLongAreLeftOutOfTheReport) {
  ASSERT_EQ(here({"run", "room.yaml", "--out", "run", "-q"}).code, 0);
  std::string text = read(folder_ / "run/effective.yaml");
  const std::string limit = "seconds: 600";
  ASSERT_NE(text.find(limit), std::string::npos) << text;
  folder_.write("run/effective.yaml", text.replace(text.find(limit), limit.size(), "seconds: 1e-9"));
  const auto outcome = here({"figures", "run"});
  EXPECT_EQ(outcome.code, 3);
  EXPECT_THAT(outcome.err, HasSubstr("the figures were not drawn: timeout"));
  EXPECT_EQ(here({"report", "run"}).code, 0);
  EXPECT_THAT(read(folder_ / "run/report.html"), Not(HasSubstr("<img")));
}

TEST_F(BadLuck, NothingIsWrittenThroughALinkOutOfTheRun) {
  ASSERT_EQ(here({"run", "room.yaml", "--out", "run", "-q"}).code, 0);
  fs::rename(folder_ / "run/figures", folder_ / "elsewhere");
  fs::create_directory_symlink(folder_ / "elsewhere", folder_ / "run/figures");
  const auto before = files(folder_ / "elsewhere");
  for (const Args& args : {Args{"figures", "run"}, Args{"score", "run"}, Args{"report", "run"},
                           Args{"run", "room.yaml", "--out", "run", "--resume"}}) {
    const auto outcome = here(args);
    EXPECT_EQ(outcome.code, 2) << args[0];
    EXPECT_THAT(outcome.err, HasSubstr("symbolic link")) << args[0];
  }
  EXPECT_THAT(differences(before, files(folder_ / "elsewhere")), IsEmpty());
}

TEST_F(BadLuck, AClosedTerminalInterruptsUnlessItIsIgnored) {
  const Args command_line = command({"run", "room.yaml", "--set", "trajectory.scans=200000", "--out", "run"});
  Child child(command_line, {}, folder_.path());
  ASSERT_TRUE(child.wait_until([&] { return child.err_so_far().find("recording") != std::string::npos; }));
  child.interrupt(SIGHUP);
  EXPECT_EQ(child.wait().code, 130);
  EXPECT_THAT(half_written(folder_.path()), IsEmpty());
  EXPECT_EQ(Child({"/bin/sh", "-c",
                   "trap '' HUP; \"" + places::program().string() +
                       "\" run room.yaml --out other -q & sleep 0.05; kill -HUP $!; wait $!"},
                  {}, folder_.path())
                .wait()
                .code,
            0);
}

}  // namespace
}  // namespace scanbench::app_test
