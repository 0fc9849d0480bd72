// Programs as modules, as a user meets them: check, describe, run, resume, and faults that stay in their cells.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <set>

#include "tests/app/program.hpp"

namespace scanbench::app_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class ForeignPrograms : public testing::Test {
 protected:
  void SetUp() override {
    if (std::system("python3 -c pass >/dev/null 2>&1") != 0) GTEST_SKIP() << "there is no python3";
  }
  static std::string example(const std::string& name) { return places::source_dir() / "examples/programs" / name; }
  std::string scenario(const std::string& extract, const std::string& more = "") const {
    return folder_.write(
        "room.yaml",
        room_with("  - {name: iepf, extract: {module: iepf, params: {threshold_m: 0.10}}}",
                  "  - {name: good, extract: {module: iepf}}\n" + more + "  - {name: mine, extract: " + extract + "}"));
  }
  /// A program in Python whose extract() has this body.
  std::string program(const std::string& name, const std::string& body) const {
    return folder_.write(name, "import os, signal, sys, time\nsys.path.insert(0, '" +
                                   (places::source_dir() / "clients").string() +
                                   "')\nimport scanbench\nclass M:\n    kind, name, version = 'extract', 'm', '1'\n"
                                   "    def __init__(self, params): pass\n    def extract(self, scan):\n        " +
                                   body + "\nscanbench.serve(M)\n");
  }
  Folder folder_;
};

TEST_F(ForeignPrograms, AreDescribed) {
  const auto outcome = run({"describe", "--program", "python3", example("split_lines.py")});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("split_lines (extract)"), HasSubstr("version 1.0"), HasSubstr("threshold_m"),
                                 HasSubstr("largest distance of a point from the chord")));
}

TEST_F(ForeignPrograms, CannotControlTheTerminalThatDescribesThem) {
  const auto file = program("escape.py", "return []\nM.summary = 'red: \\x1b[31m'");
  const auto outcome = run({"describe", "--program", "python3", file});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("red: ?[31m"), ::testing::Not(HasSubstr("\x1b"))));
}

TEST_F(ForeignPrograms, OfTheExamplesConform) {
  for (const std::string name : {"my_lines.py", "split_lines.py", "point_matcher.py"}) {
    const auto outcome = run({"module", "conform", "--program", "python3", example(name)});
    EXPECT_EQ(outcome.code, 0) << name << ": " << outcome.out << outcome.err;
  }
  EXPECT_EQ(run({"module", "conform"}).code, 2);
}

TEST_F(ForeignPrograms, BadParametersHaveTheirPlace) {
  const std::string program = "{program: [python3, '" + example("split_lines.py") + "'], params: ";
  auto outcome = run({"check", scenario(program + "{threshold_m: -1}}")});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("room.yaml:12:"), HasSubstr("threshold_m is -1; allowed: a number > 0 m")));
  outcome = run({"check", scenario(program + "{treshold_m: 1}}")});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("room.yaml:12:"), HasSubstr("did you mean 'threshold_m'?")));
  outcome = run({"check", scenario("{program: [python3, '" + example("point_matcher.py") + "']}")});
  EXPECT_THAT(outcome.err, HasSubstr("is a module of the kind match; allowed here: extract"));
  outcome = run({"check", scenario("{program: [pyhton3, x.py]}")});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("cannot be started: pyhton3: No such file"));
}

TEST_F(ForeignPrograms, RunAgainFromTheEffectiveScenarioGiveTheSameBytes) {
  const auto file = scenario("{program: [python3, '" + example("split_lines.py") + "']}");
  ASSERT_EQ(run({"run", file, "--out", folder_ / "a", "--quiet"}).code, 0);
  const auto again = run({"run", folder_ / "a/effective.yaml", "--out", folder_ / "b", "--quiet"});
  ASSERT_EQ(again.code, 0) << again.err;
  EXPECT_THAT(differences(results(folder_ / "a"), results(folder_ / "b")), testing::IsEmpty());
}

TEST_F(ForeignPrograms, HaveTheirVersionAndParametersOnThePageOfABenchmark) {
  scenario("{program: [python3, '" + example("split_lines.py") + "'], params: {min_points: 7}}");
  const auto suite = folder_.write("suite.yaml",
                                   "schema: 1\nscenarios: [room.yaml]\nmetrics: [segments, {name: efficiency, params: "
                                   "{matches: true}}, timing]\nbenchmark: {baseline: good}\nfigures: []\n");
  const auto outcome = run({"run", suite, "--out", folder_ / "a", "--quiet"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(read(folder_ / "a/manifest.json"),
              HasSubstr("\"extract split_lines of python3 split_lines.py, version 1.0: iterative end-point fit"));
  EXPECT_THAT(read(folder_ / "a/report.md"),
              HasSubstr("version 1.0 | all: max_gap_m 0.5, min_points 7, threshold_m 0.1 |"));
}

TEST_F(ForeignPrograms, AnEditedProgramIsRunAgainAndAnUnchangedOneIsNot) {
  const auto source = program("m.py", "return []");
  const auto file = scenario("{program: [python3, m.py]}");
  const Args command{"run", file, "--out", folder_ / "a", "--resume", "--json", "--no-figures"};
  ASSERT_EQ(run(command).code, 0);
  EXPECT_THAT(run(command).out, testing::Not(HasSubstr("\"reused\": false")));
  program("m.py", "return list()");
  EXPECT_THAT(run(command).out, AllOf(HasSubstr("\"reused\": false"), HasSubstr("\"reused\": true")));
  const auto refused = run({"run", folder_ / "a/effective.yaml", "--out", folder_ / "b", "--quiet"});
  EXPECT_EQ(refused.code, 0) << refused.err;
  program("m.py", "return tuple()");
  const auto changed = run({"check", folder_ / "a/effective.yaml"});
  EXPECT_EQ(changed.code, 2);
  EXPECT_THAT(changed.err, AllOf(HasSubstr("effective.yaml:"), HasSubstr("the module is now m 1 with SHA-256")));
}

TEST_F(ForeignPrograms, ReportsOfARunDoNotNeedTheProgram) {
  program("m.py", "return []");
  ASSERT_EQ(run({"run", scenario("{program: [python3, m.py]}"), "--out", folder_ / "a", "--quiet"}).code, 0);
  fs::remove(folder_ / "m.py");
  const auto outcome = run({"report", folder_ / "a"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
}

class SandboxedPrograms : public ForeignPrograms {
 protected:
  void SetUp() override {
    ForeignPrograms::SetUp();
    if (std::system("bwrap --unshare-all --ro-bind / / true >/dev/null 2>&1") != 0)
      GTEST_SKIP() << "bubblewrap is not installed or not allowed";
  }
  /// A scenario with a program in Python. The sandbox shows the client because it is a file of the program.
  std::string scenario_of(const std::string& name) const {
    return scenario("{program: [python3, " + name + "], files: ['" +
                    (places::source_dir() / "clients/scanbench.py").string() + "']}");
  }
};

TEST_F(SandboxedPrograms, CanWriteOnlyToAFolderOfTheirOwn) {
  const auto outside = folder_ / "outside";
  program("writes.py", "open('inside', 'w').close()\n        open('" + outside.string() + "', 'w').close()");
  const auto file = scenario_of("writes.py");
  const auto outcome = run({"run", file, "--out", folder_ / "a", "--sandbox", "--json", "--no-figures"});
  EXPECT_EQ(outcome.code, 3) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("Read-only file system: '" + outside.string() + "'"));
  EXPECT_FALSE(fs::exists(outside));
  EXPECT_THAT(read(folder_ / "a/manifest.json"), HasSubstr("\"bubblewrap (programs)\""));
  ASSERT_EQ(run({"run", file, "--out", folder_ / "b", "--quiet", "--no-figures"}).code, 3);
  EXPECT_TRUE(fs::exists(outside)) << "without the sandbox nothing keeps the program from writing";
}

TEST_F(SandboxedPrograms, HaveNoCapabilitiesAndNoTerminal) {
  program("tries.py",
          "services = os.listdir('/run')\n"
          "        status = dict(line.split(':', 1) for line in open('/proc/self/status'))\n"
          "        found = [status[k].strip().strip('0') for k in ('CapEff', 'CapPrm', 'CapBnd')]\n"
          "        remount = os.system('mount -o remount,rw,bind / 2>/dev/null') == 0\n"
          "        nested = os.system('unshare -U true 2>/dev/null') == 0\n"
          "        raise ValueError(f'{found} {remount} {nested} {os.getsid(0) == 0} {services}')");
  const auto outcome =
      run({"run", scenario_of("tries.py"), "--out", folder_ / "a", "--sandbox", "--json", "--no-figures"});
  EXPECT_EQ(outcome.code, 3) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("ValueError: ['', '', ''] False False False []"))
      << "capabilities, remounted, nested user namespace, session of a process outside, sockets of services";
}

TEST_F(SandboxedPrograms, SeeNeitherTheTruthNorOtherFilesNorOtherProcesses) {
  const Folder other;
  const std::string secret = other.write("secret", "of the user").string();
  program("looks.py", "truth = [f for _, _, names in os.walk('" + folder_.path().string() +
                          "') for f in names if f in ('walls.csv', 'lines.csv')]\n"
                          "        processes = [p for p in os.listdir('/proc') if p.isdigit()]\n"
                          "        raise ValueError(f'{len(truth) > 0} {os.path.exists(\"" +
                          secret + "\")} {len(processes) > 3}')");
  const auto outcome =
      run({"run", scenario_of("looks.py"), "--out", folder_ / "a", "--sandbox", "--json", "--no-figures"});
  EXPECT_EQ(outcome.code, 3) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("ValueError: False False False"));
  const auto open = run({"run", scenario_of("looks.py"), "--out", folder_ / "b", "--json", "--no-figures"});
  EXPECT_THAT(open.out, HasSubstr("ValueError: True True True")) << "without the sandbox nothing is hidden";
}

TEST_F(SandboxedPrograms, CannotPassFilesOffAsResults) {
  program("honest.py", "return []");
  program("plants.py",
          "if not os.path.lexists('status.json'):\n"
          "            os.mkfifo('status.json')\n"
          "            os.symlink('/etc/passwd', 'map.csv')\n"
          "            os.makedirs('metrics.csv/deep')\n"
          "            open('poses.csv', 'w').write('no poses')\n"
          "        return []");
  for (const std::string name : {"honest", "plants"}) {
    const auto outcome = run({"run", scenario_of(name + ".py"), "--out", folder_ / name, "--sandbox", "--quiet"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
  }
  std::set<std::string> honest, planted;
  for (const auto& entry : fs::directory_iterator(folder_ / "honest/cells/room/mine/1"))
    honest.insert(entry.path().filename().string());
  for (const auto& entry : fs::directory_iterator(folder_ / "plants/cells/room/mine/1")) {
    planted.insert(entry.path().filename().string());
    EXPECT_EQ(entry.symlink_status().type(), fs::file_type::regular) << entry.path();
  }
  EXPECT_EQ(planted, honest);
  EXPECT_EQ(read(folder_ / "plants/cells/room/mine/1/lines.csv"), read(folder_ / "honest/cells/room/mine/1/lines.csv"));
}

TEST_F(ForeignPrograms, ThatDescribeThemselvesWithDeeplyNestedJsonAreRefused) {
  const auto file = folder_.write("nests.py",
                                  "import os, socket, struct\n"
                                  "connection = socket.socket(fileno=int(os.environ['SCANBENCH_FD']))\n"
                                  "text = b'{\"id\":1,\"error\":' + b'[' * 500000 + b']' * 500000 + b'}'\n"
                                  "connection.recv(4096)\n"
                                  "connection.sendall(struct.pack('<4sIQ', b'SBF1', len(text), 0) + text)\n");
  const auto outcome = run({"check", scenario("{program: [python3, nests.py]}")});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("room.yaml:12:"), HasSubstr("nested more than 32 deep"))) << file;
}

TEST_F(ForeignPrograms, AFaultSpoilsOnlyItsOwnCell) {
  program("raises.py", "raise ValueError('no such wall')");
  program("nan.py", "line = scan.fitted_line(scan.valid_beams()); line.rho = float('nan'); return [line]");
  const auto file =
      scenario("{program: [python3, raises.py]}", "  - {name: nan, extract: {program: [python3, nan.py]}}\n");
  const auto outcome = run({"run", file, "--out", folder_ / "a", "--json", "--jobs", "2"});
  EXPECT_EQ(outcome.code, 3);
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("extract, frame 0: "), HasSubstr("ValueError: no such wall"),
                                 HasSubstr("extract, frame 0: line 0 is not finite")));
  ASSERT_EQ(run({"run", file, "--out", folder_ / "b", "--only", "good", "--quiet"}).code, 0);
  EXPECT_EQ(read(folder_ / "a/cells/room/good/1/lines.csv"), read(folder_ / "b/cells/room/good/1/lines.csv"));
}

}  // namespace
}  // namespace scanbench::app_test
