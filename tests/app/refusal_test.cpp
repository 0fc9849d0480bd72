// Wrong input: exit code 2, a message with the place and the allowed values, nothing written, nothing lost.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <iterator>
#include <utility>

#include "tests/app/program.hpp"

namespace scanbench::app_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// `scanbench check` on this text must refuse it; gives the message.
std::string refusal_of(const std::string& text) {
  const Folder folder;
  folder.write("x.yaml", text);
  const auto outcome = run({"check", "x.yaml"}, {}, folder.path());
  EXPECT_EQ(outcome.code, 2) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  return outcome.err;
}

/// The command must be refused and leave the folder as it was.
std::string refusal_in(const Folder& folder, const Args& args, const Env& env = {}) {
  const auto before = files(folder.path());
  const auto outcome = run(args, env, folder.path());
  EXPECT_EQ(outcome.code, 2) << outcome.err;
  EXPECT_THAT(differences(before, files(folder.path())), IsEmpty());
  return outcome.err;
}

TEST(Refusals, OfTheCommandLineSayWhatIsAllowed) {
  const Folder folder;
  folder.write("room.yaml", room());
  EXPECT_THAT(refusal_in(folder, {"rnu"}), AllOf(HasSubstr("'rnu'"), HasSubstr("did you mean 'run'?")));
  EXPECT_THAT(refusal_in(folder, {}), HasSubstr("a verb is missing"));
  EXPECT_THAT(refusal_in(folder, {"run"}), HasSubstr("'run' needs FILE: scenario or suite files"));
  EXPECT_THAT(refusal_in(folder, {"compare", "out"}), HasSubstr("'compare' needs B: the run folder"));
  EXPECT_THAT(refusal_in(folder, {"run", "room.yaml", "--frobnicate"}), HasSubstr("--frobnicate"));
  EXPECT_THAT(refusal_in(folder, {"run", "nowhere.yaml"}), HasSubstr("nowhere.yaml: no such file"));
  EXPECT_THAT(refusal_in(folder, {"run", "rom.yaml"}), HasSubstr("did you mean 'room.yaml'?"));
  EXPECT_THAT(refusal_in(folder, {"run", "room.yaml", "--job", "2"}), HasSubstr("did you mean '--jobs'?"));
  EXPECT_THAT(refusal_in(folder, {"run", "room.yaml", "--no-figure=1"}), HasSubstr("did you mean '--no-figures'?"));
  EXPECT_THAT(refusal_in(folder, {"run", "\x1b[31mred.yaml"}), Not(HasSubstr("\x1b")));
  for (const char* seed : {"garbage", "-1", "1x", "9007199254740993", "99999999999999999999999"})
    EXPECT_THAT(refusal_in(folder, {"run", "room.yaml", "--seed", seed}),
                AllOf(HasSubstr(std::string("'") + seed + "'"), HasSubstr("0 .. 9007199254740992")));
  EXPECT_THAT(refusal_in(folder, {"run", "room.yaml", "--seed", "4,4"}), HasSubstr("4 is given twice"));
  for (const char* jobs : {"0", "many"})
    EXPECT_THAT(
        refusal_in(folder, {"run", "room.yaml", "--jobs", jobs}),
        AllOf(HasSubstr(std::string("--jobs: '") + jobs + "'"), HasSubstr("allowed: a whole number 1 .. 1024")));
  EXPECT_THAT(refusal_in(folder, {"export", "out", "--format", "csw"}),
              AllOf(HasSubstr("'csw' is not a format; did you mean 'csv'?"), HasSubstr("allowed: carmen, csv")));
  EXPECT_THAT(refusal_in(folder, {"run", "room.yaml", "--only", "smf"}),
              AllOf(HasSubstr("'smf'"), HasSubstr("known: room, iepf")));
  EXPECT_THAT(refusal_in(folder, {"run", "room.yaml", "--set", "trajectory.scan=3"}),
              AllOf(HasSubstr("--set trajectory.scan=3"), HasSubstr("did you mean 'scans'?")));
  EXPECT_THAT(refusal_in(folder, {"run", "room.yaml", "--set", "trajectory.scans"}), HasSubstr("key=value"));
  EXPECT_THAT(refusal_in(folder, {"run", "room.yaml", "room.yaml"}), HasSubstr("two scenarios are called 'room'"));
  for (const char* verb : {"score", "figures", "report", "export"})
    EXPECT_THAT(refusal_in(folder, {verb, "nowhere"}), HasSubstr("nowhere: no such folder"));
}

TEST(Refusals, OfAFileNamePlaceFindingAndWhatIsAllowed) {
  EXPECT_THAT(refusal_of(room_with("scans:", "scanz:")),
              AllOf(HasSubstr("x.yaml:9:65: "), HasSubstr("'scanz'"), HasSubstr("did you mean 'scans'?")));
  EXPECT_THAT(refusal_of(room_with("scans: 5", "scans: many")),
              AllOf(HasSubstr("x.yaml:9:72: "), HasSubstr("'many'"), HasSubstr("a whole number")));
  EXPECT_THAT(refusal_of(room_with("scans: 5", "scans: -5")), AllOf(HasSubstr("x.yaml:9:72: "), HasSubstr("-5")));
  EXPECT_THAT(refusal_of(room_with("0.10", ".nan")), AllOf(HasSubstr("x.yaml:11:64: "), HasSubstr(".nan")));
  EXPECT_THAT(refusal_of(room_with("0.10", ".inf")), HasSubstr("x.yaml:11:64: "));
  EXPECT_THAT(refusal_of(room_with("module: iepf", "module: iefp")),
              AllOf(HasSubstr("x.yaml:11:36: "), HasSubstr("did you mean 'iepf'?")));
  EXPECT_THAT(refusal_of(room_with("[segments]", "[segmets]")), HasSubstr("did you mean 'segments'?"));
  EXPECT_THAT(refusal_of(room_with("[segments]", "[segments, segments]")), HasSubstr("x.yaml:12:"));
  EXPECT_THAT(refusal_of(room_with("[environment]", "[portrait]")), HasSubstr("'portrait'"));
  EXPECT_THAT(refusal_of(room() + "seeds: {first: 9007199254740992, count: 2}\n"),
              AllOf(HasSubstr("x.yaml:14:8: "), HasSubstr("9007199254740993")));
  EXPECT_THAT(refusal_of(room_with("schema: 1", "schema: 7")), HasSubstr("x.yaml:1:9: schema is 7"));
  EXPECT_THAT(refusal_of(room_with("metrics:", "  - {name: iepf, extract: {module: sef}}\nmetrics:")),
              AllOf(HasSubstr("x.yaml:12:"), HasSubstr("iepf")));
  EXPECT_THAT(refusal_of(room_with("world:\n", "world:\n  file: nowhere.yaml\n")), HasSubstr("x.yaml:"));
}

TEST(Refusals, OfAWorldNameTheWallAndThePlace) {
  EXPECT_THAT(refusal_of(room_with("0, 0, 10, 0", "3, 4, 3, 4")),
              AllOf(HasSubstr("x.yaml:4:7: "), HasSubstr("wall a has no length")));
  EXPECT_THAT(refusal_of("schema: 1\nworld: {segments: []}\n" + room().substr(room().find("sensor:"))),
              HasSubstr("the world has no walls"));
  EXPECT_THAT(refusal_of(room_with("B: [7, 5]", "B: [18, 2]")),  // straight from (2, 2) through x = 10
              AllOf(HasSubstr("wall 'b'"), HasSubstr("(10, 2) m")));
  EXPECT_THAT(refusal_of(room_with("{kind: waypoints, points_m: {A: [2, 2], B: [7, 5]}, scans: 5}",
                                   "{kind: robots, robots: [[10, 4, 0]]}")),
              AllOf(HasSubstr("'b'"), HasSubstr("(10, 4)")));
}

TEST(Refusals, OfWhatIsNoTextOrNoScenarioAtAll) {
  EXPECT_THAT(refusal_of(""), HasSubstr("x.yaml"));
  EXPECT_THAT(refusal_of(std::string("schema: 1\0", 10)), HasSubstr("x.yaml:1:10: "));
  EXPECT_THAT(refusal_of("\xff\xfe\x00"), HasSubstr("x.yaml:1:1: "));
  EXPECT_THAT(refusal_of("schema: 1\nworld: " + std::string(100000, '[')), HasSubstr("x.yaml:"));
  EXPECT_THAT(refusal_of("- 1\n- 2\n"), HasSubstr("x.yaml:1:1: "));
  EXPECT_THAT(refusal_of("schema: 1\nlog: my.log\n"), HasSubstr("or recording: {log: FILE, ...}"));
  EXPECT_THAT(refusal_of("schema: 1\nrecording: {log: ${SCANBENCH_DATA}/my.log, format: carmen}\n"),
              AllOf(HasSubstr("x.yaml:2:"), HasSubstr("a path with ${SCANBENCH_DATA} needs quotes")));
  const Folder folder;
  EXPECT_THAT(refusal_in(folder, {"check", "."}),
              HasSubstr(".: a folder, not a regular file; allowed: a scenario or suite file"));
  EXPECT_THAT(refusal_in(folder, {"check", "/dev/null"}), HasSubstr("not a regular file"));
}

TEST(Refusals, OfARecordedLogNameItsLine) {
  const Folder folder;
  std::string beams;
  for (int i = 0; i < 180; ++i) beams += " 2.5";
  const std::string scan = "FLASER 180" + beams + " 0 0 0 0 0 0 1.0 host 1.0\n";
  const std::string pipelines = room().substr(room().find("pipelines:"));
  folder.write("s.yaml", "schema: 1\nrecording: {log: x.log, format: carmen, no_return_m: 80}\n" +
                             pipelines.substr(0, pipelines.find("metrics:")) + "metrics: [siadat1997]\n");
  const auto refusal = [&](const std::string& log) {
    folder.write("x.log", log);
    return refusal_in(folder, {"run", "s.yaml", "--out", "out"});
  };
  EXPECT_THAT(refusal(scan + "FLASER 180 2.5 2.5"), HasSubstr("x.log:2:"));
  EXPECT_THAT(refusal(scan + scan + "FLASER 179" + beams + " 0 0 0 0 0 0 1.0 host 1.0\n"), HasSubstr("x.log:3:"));
  EXPECT_THAT(refusal("this is a letter\nnot a log\n"), HasSubstr("x.log"));
  EXPECT_THAT(refusal(""), HasSubstr("x.log"));
  fs::remove(folder / "x.log");
  EXPECT_THAT(refusal_in(folder, {"run", "s.yaml", "--out", "out"}), HasSubstr("x.log"));
  EXPECT_THAT(refusal_in(folder, {"check", "s.yaml", "--set", "recording.log=${SCANBENCH_ABSENT}/x.log"}),
              HasSubstr("SCANBENCH_ABSENT"));
  folder.write("x.log", scan + scan);  // and the same scenario with a good log is good
  EXPECT_EQ(run({"run", "s.yaml", "--out", "out", "-q"}, {}, folder.path()).code, 0);
}

TEST(Refusals, OfMemoryComeAtOnceWithTheCalculation) {
  const Folder folder;
  folder.write("room.yaml", room_with("scans: 5", "scans: 1000000"));
  // 361 beams x 20 bytes x 1e6 frames = 7.2e9 bytes, more than 4 GiB; the frames themselves need more.
  for (const Args& args : {Args{"run", "room.yaml", "--out", "a/b/c"}, Args{"check", "room.yaml"},
                           Args{"simulate", "room.yaml", "--out", "a/b/c"}})
    EXPECT_THAT(refusal_in(folder, args),
                AllOf(HasSubstr("1000000 frames x 361 beams"), HasSubstr("limits.memory_mib")));
  EXPECT_FALSE(fs::exists(folder / "a")) << "folders made on the way to the run folder stay behind";
}

TEST(OutputFolder, ThatIsNotARunIsLeftAlone) {
  const Folder folder;
  folder.write("room.yaml", room());
  folder.write("thesis/chapter.txt", "years of work");
  folder.write("file", "text");
  folder.write("other/manifest.json", "{\"program\": \"somebody else's\"}");
  fs::create_symlink("nowhere", folder / "dangling");
  EXPECT_THAT(refusal_in(folder, {"run", "room.yaml", "--out", "thesis"}), HasSubstr("not the folder of a run"));
  EXPECT_THAT(refusal_in(folder, {"run", "room.yaml", "--out", "thesis", "--resume"}),
              HasSubstr("not the folder of a run"));
  EXPECT_THAT(refusal_in(folder, {"simulate", "room.yaml", "--out", "thesis"}), HasSubstr("not the folder of a run"));
  EXPECT_THAT(refusal_in(folder, {"run", "room.yaml", "--out", "file"}), HasSubstr("is a file"));
  EXPECT_THAT(refusal_in(folder, {"run", "room.yaml", "--out", "file/below"}), HasSubstr("file/below"));
  EXPECT_THAT(refusal_in(folder, {"run", "room.yaml", "--out", "other"}), HasSubstr("manifest.json"));
  EXPECT_THAT(refusal_in(folder, {"run", "room.yaml", "--out", "dangling"}), HasSubstr("broken symbolic link"));
  EXPECT_FALSE(fs::exists(folder / "nowhere"));
}

TEST(AFileOrFolder, ThatIsALinkToItselfIsRefusedWithItsName) {
  const Folder folder;
  fs::create_symlink("loop.yaml", folder / "loop.yaml");
  for (const std::string verb : {"check", "run", "report", "figures", "export"}) {
    const auto outcome = run({verb, "loop.yaml"}, {}, folder.path());
    EXPECT_EQ(outcome.code, 2) << verb;
    EXPECT_THAT(outcome.err, AllOf(HasSubstr("scanbench: loop.yaml: "), HasSubstr("symbolic link"),
                                   Not(HasSubstr("filesystem error"))))
        << verb;
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()), 1) << verb;
  }
}

TEST(OutputFolder, ThatMayNotBeWrittenIsRefused) {
  if (geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  const Folder folder;
  folder.write("room.yaml", room());
  fs::create_directories(folder / "locked");
  fs::permissions(folder / "locked", fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_THAT(refusal_in(folder, {"run", "room.yaml", "--out", "locked"}), HasSubstr("Permission denied"));
  fs::permissions(folder / "locked", fs::perms::owner_all);
}

TEST(OutputFolder, OnADiskThatIsFullHoldsNoHalfWrittenFileAndTheOldRunStays) {
  const Folder folder;
  folder.write("room.yaml", room());
  const std::string run_it = places::program().string() + " run room.yaml -q --out run";
  ASSERT_EQ(run({"run", "room.yaml", "-q", "--out", "run"}, {}, folder.path()).code, 0);
  const auto before = files(folder.path());
  // The limit cuts files at 1 KiB (in the manifest, so nothing begins) and at 4 KiB (in the recording, so all cells are
  // missing).
  for (const auto& [limit, code] : {std::pair("1", 2), std::pair("4", 4)}) {
    const auto outcome = Child({"/bin/bash", "-c", std::string("ulimit -f ") + limit + "; " + run_it + " --set seed=2"},
                               {}, folder.path())
                             .wait();
    EXPECT_EQ(outcome.code, code) << outcome.err;
    EXPECT_THAT(outcome.err, AllOf(HasSubstr("cannot write"), HasSubstr("File too large")));
    EXPECT_THAT(differences(before, files(folder.path())), IsEmpty());
  }
  fs::remove_all(folder / "run");
  const auto fresh = Child({"/bin/bash", "-c", "ulimit -f 4; " + run_it}, {}, folder.path()).wait();
  EXPECT_EQ(fresh.code, 4) << fresh.err;
  EXPECT_THAT(half_written(folder.path()), IsEmpty());
  EXPECT_EQ(run({"run", "room.yaml", "-q", "--out", "run", "--resume"}, {}, folder.path()).code, 0);
}

TEST(OutputFolder, OfAnInterruptedSimulationVanishes) {
  const Folder folder;
  folder.write("room.yaml", room_with("scans: 5", "scans: 200000"));
  Child child(command({"simulate", "room.yaml", "--out", "a/b"}), {}, folder.path());
  ASSERT_TRUE(child.wait_until([&] { return child.err_so_far().find("recording") != std::string::npos; }));
  child.interrupt();
  EXPECT_EQ(child.wait().code, 130);
  EXPECT_FALSE(fs::exists(folder / "a"));
}

TEST(StandardOutput, ThatCannotBeWrittenIsNoBugOfTheProgram) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  for (const char* verb : {"list", "describe --all"}) {
    const auto outcome =
        Child({"/bin/bash", "-c", places::program().string() + " " + verb + " > /dev/full"}, {}, {}).wait();
    EXPECT_EQ(outcome.code, 2) << verb << ": " << outcome.err;
    EXPECT_THAT(outcome.err, Not(HasSubstr("internal error")));
  }
}

TEST(OutputFolder, KeepsTheOldRunWhenTheNewOneIsInterrupted) {
  const Folder folder;
  folder.write("room.yaml", room());
  ASSERT_EQ(run({"run", "room.yaml", "-q", "--out", "run"}, {}, folder.path()).code, 0);
  const auto before = files(folder.path());
  Child child(command({"run", "room.yaml", "--set", "trajectory.scans=200000", "--out", "run"}), {}, folder.path());
  ASSERT_TRUE(child.wait_until([&] { return child.err_so_far().find("recording") != std::string::npos; }));
  child.interrupt();
  const auto outcome = child.wait();
  EXPECT_EQ(outcome.code, 130);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("interrupted"), Not(HasSubstr("internal error"))));
  EXPECT_THAT(differences(before, files(folder.path())), IsEmpty());
  EXPECT_THAT(half_written(folder.path()), IsEmpty());
}

}  // namespace
}  // namespace scanbench::app_test
