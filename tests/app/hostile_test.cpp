// Shared libraries and programs as modules: good ones, those of another build, and ones that do all that a module must
// not do.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <iterator>
#include <map>
#include <sstream>
#include <utility>

#include <nlohmann/json.hpp>

#include "tests/app/program.hpp"

namespace scanbench::app_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

struct CellEnd {
  std::string status, message;
};

class Plugins : public testing::Test {
 protected:
  std::string scenario(const std::string& pipelines, const std::string& limits = "limits: {seconds: 20}\n") const {
    return folder_.write("room.yaml",
                         room_with("  - {name: iepf, extract: {module: iepf, params: {threshold_m: 0.10}}}\n",
                                   "  - {name: good, extract: {module: iepf}}\n" + pipelines) +
                             limits);
  }
  CellEnd end_of(const std::string& pipeline, const std::string& run = "a") const {
    const auto json = nlohmann::json::parse(read(folder_ / run / "cells/room" / pipeline / "1/status.json"));
    return {json.at("status"), json.at("message")};
  }
  void expect_ends(const std::map<std::string, CellEnd>& expected) const;
  void expect_good_one_untouched() const;
  Folder folder_;
};

std::vector<std::size_t> lengths_of_lines(const std::string& text) {
  std::vector<std::size_t> lengths{0};
  for (const char c : text) c == '\n' ? lengths.push_back(0) : void(++lengths.back());
  return lengths;
}

TEST_F(Plugins, TheReadmesModuleBuiltInGivesTheLinesOfTheLibraryAndOfTheProgramsInCAndPython) {
  const std::string library = places::plugin("my_lines");
  const bool python = std::system("python3 -c pass >/dev/null 2>&1") == 0;
  const std::string c = library.substr(0, library.rfind('/')) + "/my_lines_c";
  std::string pipelines = "  - {name: c, extract: {program: ['" + c + "']}}\n";
  if (python)
    pipelines += "  - {name: python, extract: {program: [python3, '" +
                 (places::source_dir() / "examples/programs/my_lines.py").string() + "']}}\n";
  // The program of the first run has the module itself; that of the second loads it from the library.
  const std::string mine = "  - {name: mine, extract: {module: my_lines}}\n";
  const auto built_in = Child({library.substr(0, library.rfind('/')) + "/scanbench_with_my_lines", "run",
                               scenario(mine), "--out", folder_ / "b", "--quiet"},
                              {}, {})
                            .wait();
  ASSERT_EQ(built_in.code, 0) << built_in.err;
  const auto outcome = run({"run", scenario(mine + pipelines), "--plugin", library, "--out", folder_ / "a", "--quiet"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const std::string lines = read(folder_ / "b/cells/room/mine/1/lines.csv");
  EXPECT_EQ(std::count(lines.begin(), lines.end(), '\n'), 6);
  const auto numbers = [](const std::string& csv) {
    std::string text = csv.substr(csv.find('\n') + 1);
    std::ranges::replace(text, ',', ' ');
    std::istringstream words(text);
    return std::vector<double>{std::istream_iterator<double>(words), {}};
  };
  const std::vector<double> expected = numbers(lines);
  EXPECT_EQ(expected.size(), 60u);  // five frames, twelve columns
  EXPECT_THAT(numbers(read(folder_ / "a/cells/room/mine/1/lines.csv")),
              testing::Pointwise(testing::DoubleNear(1e-12), expected));
  EXPECT_THAT(numbers(read(folder_ / "a/cells/room/c/1/lines.csv")),
              testing::Pointwise(testing::DoubleNear(1e-12), expected));
  if (!python) GTEST_SKIP() << "there is no python3";
  EXPECT_THAT(numbers(read(folder_ / "a/cells/room/python/1/lines.csv")),
              testing::Pointwise(testing::DoubleNear(1e-12), expected));
}

TEST_F(Plugins, AreDescribedAndCheckedWithoutBeingLoadedHere) {
  const std::string library = places::plugin("my_lines");
  const auto described = run({"describe", "--plugin", library});
  EXPECT_EQ(described.code, 0) << described.err;
  EXPECT_THAT(described.out, AllOf(HasSubstr("my_lines (extract)"), HasSubstr("min_points")));
  const auto file = folder_.write("p.yaml", room_with("{module: iepf, params: {threshold_m: 0.10}}",
                                                      "{module: my_lines, params: {min_points: 0}}") +
                                                "plugins: ['" + library + "']\n");
  const auto checked = run({"check", file});
  EXPECT_EQ(checked.code, 2);
  EXPECT_THAT(checked.err, AllOf(HasSubstr("p.yaml:11:"), HasSubstr("min_points is 0; allowed: a whole number >= 2")));
}

TEST_F(Plugins, ThatStartADaemonWhileTheyAreLoadedLeaveNothing) {
  const auto begun = std::chrono::steady_clock::now();
  run({"check", scenario(""), "--plugin", places::plugin("hostile")},
      {{"HOSTILE_DAEMON", (folder_ / "daemon").string()}});
  EXPECT_LT(std::chrono::steady_clock::now() - begun, std::chrono::seconds(30));
  // A daemon that was killed before it had written its number has left nothing either.
  const std::string daemon = read(folder_ / "daemon");
  EXPECT_TRUE(daemon.empty() || kill(std::stoi(daemon), 0) != 0) << daemon;
}

TEST_F(Plugins, OfAnotherBuildAreRefused) {
  std::string bytes = read(places::plugin("my_lines"));
  const auto at = bytes.find("version=", bytes.find("scanbench-plugin{"));
  ASSERT_NE(at, std::string::npos);
  bytes.replace(at, 13, "version=9.9.9");
  const auto outcome = run({"describe", "--plugin", folder_.write("old.so", bytes)});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("library old.so was built for another scanbench"),
                                 HasSubstr("version 9.9.9 instead of ")));
  EXPECT_THAT(run({"describe", "--plugin", places::plugin("no_stamp")}).err, HasSubstr("has no stamp"));
  EXPECT_THAT(run({"describe", "--plugin", folder_.write("text.so", "hello")}).err,
              HasSubstr("is not a shared library"));
  EXPECT_THAT(run({"describe", "--plugin", places::plugin("fast_math")}).err,
              HasSubstr("changes the floating-point arithmetic"));
}

/// What every cell must say, for programs and libraries alike.
void Plugins::expect_ends(const std::map<std::string, CellEnd>& expected) const {
  for (const auto& [how, end] : expected) {
    const CellEnd found = end_of(how);
    EXPECT_EQ(found.status, end.status) << how << ": " << found.message;
    EXPECT_THAT(found.message, HasSubstr(end.message)) << how;
    EXPECT_LE(std::ranges::max(lengths_of_lines(found.message)), 500u) << how << ": " << found.message;
  }
  EXPECT_EQ(end_of("good").status, "ok");
  // The kernel does not limit the processes of root, unless there is a control group for it.
  const std::string manifest = read(folder_ / "a/manifest.json");
  if (manifest.find("RLIMIT_NPROC") != std::string::npos || manifest.find("pids.max") != std::string::npos) {
    EXPECT_THAT(end_of("fork_storm").message, HasSubstr("no process after "));
  }
  // What left its session is gone too.
  const std::string message = end_of("daemon").message;
  const std::size_t at = message.find("daemon ");
  ASSERT_NE(at, std::string::npos) << message;
  const int daemon = std::stoi(message.substr(at + 7));
  EXPECT_NE(kill(daemon, 0), 0) << "process " << daemon << " has outlived its cell";
}

/// The bytes of the good one are those of a run without the others.
void Plugins::expect_good_one_untouched() const {
  ASSERT_EQ(run({"run", scenario(""), "--out", folder_ / "b", "--quiet", "--no-figures"}).code, 0);
  for (const std::string file : {"lines.csv", "labels.npy", "metrics.csv"})
    EXPECT_EQ(read(folder_ / "a/cells/room/good/1" / file), read(folder_ / "b/cells/room/good/1" / file)) << file;
}

TEST_F(Plugins, ThatMisbehaveSpoilOnlyTheirOwnCells) {
  std::map<std::string, CellEnd> expected{{"segfault", {"crashed", "signal 11"}},
                                          {"abort", {"crashed", "signal 6"}},
                                          {"exit", {"crashed", "ended without a result, exit code 0"}},
                                          {"loop", {"timeout", "took longer than the limit of 3 s"}},
                                          {"memory", {"out_of_memory", "under the memory limit"}},
                                          {"fork_storm", {"failed", ""}},
                                          {"output", {"failed", "written"}},
                                          {"close_descriptors", {"crashed", "ended without a result"}},
                                          {"kill_parent", {"crashed", "sent a signal to scanbench itself"}},
                                          {"kill_itself", {"crashed", "ended by signal 9 (Killed)"}},
                                          {"daemon", {"crashed", "daemon "}}};
  if (kSanitized) {  // a sanitizer needs address space without a limit, and reports a fault itself before the process
                     // ends
    expected["segfault"] = {"crashed", "ended without a result"};
    expected.erase("memory");
  }
  std::string pipelines;
  for (const auto& [how, end] : expected)
    pipelines += "  - {name: " + how + ", extract: {module: hostile, params: {how: " + how + "}}}\n";
  const auto file = scenario(
      pipelines, "limits: {seconds: 3, memory_mib: 256}\nplugins: ['" + places::plugin("hostile").string() + "']\n");
  const auto outcome = run({"run", file, "--out", folder_ / "a", "--jobs", "2", "--quiet", "--no-figures"});
  EXPECT_EQ(outcome.code, 3) << outcome.err;
  expect_ends(expected);
  expect_good_one_untouched();
}

TEST_F(Plugins, ThatAreProgramsAndMisbehaveSpoilOnlyTheirOwnCells) {
  if (std::system("python3 -c pass >/dev/null 2>&1") != 0) GTEST_SKIP() << "there is no python3";
  std::map<std::string, CellEnd> expected{
      {"segfault", {"crashed", "ended by signal 11 (Segmentation fault) without answering"}},
      {"abort", {"crashed", "ended by signal 6 (Aborted) without answering"}},
      {"exit", {"crashed", "ended with exit code 0 without answering"}},
      {"loop", {"timeout", "did not answer within 1 s"}},
      {"ignore_sigterm", {"timeout", "did not answer within 1 s"}},
      {"late", {"timeout", "did not answer within 1 s"}},
      {"stop", {"timeout", "did not answer within 1 s"}},
      {"memory", {"out_of_memory", "reports an error: MemoryError"}},
      {"fork_storm", {"failed", "reports an error: RuntimeError: "}},
      {"output", {"failed", "reports an error: RuntimeError: written"}},
      {"flood", {"failed", "sent 'xxxxxxxxxxxxxxxx' instead of a frame"}},
      {"huge_answer", {"failed", "announces 1099511627776 numbers; allowed: up to 8388608"}},
      {"more_answers", {"failed", "answered to call 1 instead of call 3"}},
      {"close_descriptors", {"crashed", "without answering"}},
      {"kill_worker", {"crashed", "ended by signal 9 (Killed)"}},
      {"kill_scanbench", {"crashed", "sent a signal to scanbench itself"}},
      {"daemon", {"crashed", "daemon "}},
      {"nan", {"invalid", "line 0 is not finite"}},
      {"too_many_labels", {"invalid", "362 labels for 361 beams"}},
      {"wrong_kind", {"invalid", "the answer has no array `lines`"}},
      {"exit_at_once", {"crashed", "ended with exit code 5 without answering"}},
      {"other_protocol", {"failed", "protocol"}},
      {"other_name", {"failed", "is now extract friendly 1; it was extract hostile 1 when the run was planned"}}};
  if (kSanitized) expected.erase("memory");  // a sanitizer needs address space without a limit
  const std::string program = places::source_dir() / "tests/plugins/hostile.py";
  std::string pipelines;
  for (const auto& [how, end] : expected) {
    const bool at_start = how == "exit_at_once" || how.starts_with("other_");
    pipelines += "  - {name: " + how + ", extract: {program: [python3, '" + program + "', " + how +
                 (at_start ? ", '" + (folder_ / how).string() + "'" : "") + "]" +
                 (end.status == "timeout" ? ", scan_seconds: 1" : "") + "}}\n";
  }
  const auto file = scenario(pipelines, "limits: {seconds: 60, memory_mib: 256}\n");
  const auto outcome = run({"run", file, "--out", folder_ / "a", "--jobs", "2", "--quiet", "--no-figures"});
  EXPECT_EQ(outcome.code, 3) << outcome.err;
  expect_ends(expected);
  expect_good_one_untouched();
}

TEST_F(Plugins, ThatStartProcessesShareTheMemoryOfTheirCell) {
  if (std::system("python3 -c pass >/dev/null 2>&1") != 0) GTEST_SKIP() << "there is no python3";
  if (kSanitized) GTEST_SKIP() << "a sanitizer needs address space without a limit";
  const auto file =
      scenario("  - {name: many, extract: {program: [python3, '" +
                   (places::source_dir() / "tests/plugins/hostile.py").string() + "', memory_of_many]}}\n",
               "limits: {seconds: 60, memory_mib: 256}\n");
  ASSERT_EQ(run({"run", file, "--out", folder_ / "a", "--quiet", "--no-figures"}).code, 3);
  EXPECT_EQ(end_of("good").status, "ok");
  const auto manifest = nlohmann::json::parse(read(folder_ / "a/manifest.json"));
  if (!manifest.at("sandbox").at("cells").at("one limit of memory for all processes"))
    GTEST_SKIP() << "control groups are not allowed here";
  EXPECT_THAT(end_of("many").message, testing::AnyOf(HasSubstr("a process was killed"), HasSubstr("memory ran out")));
}

TEST_F(Plugins, ThatAreProgramsAndCannotDescribeThemselvesAreRefusedBeforeTheRun) {
  const auto refusal = [&](const std::string& program) {
    const auto outcome = run(
        {"run", scenario("  - {name: bad, extract: {program: " + program + "}}\n"), "--out", folder_ / "a", "--quiet"});
    EXPECT_EQ(outcome.code, 2) << program;
    EXPECT_FALSE(fs::exists(folder_ / "a")) << program;
    EXPECT_THAT(outcome.err, HasSubstr("room.yaml:12:"));
    return outcome.err;
  };
  EXPECT_THAT(refusal("[/bin/false]"), HasSubstr("ended with exit code 1 without answering"));
  EXPECT_THAT(refusal("[./nowhere]"), HasSubstr("no such file: ./nowhere"));
  EXPECT_THAT(refusal("[/tmp]"), HasSubstr("/tmp: not a regular file; allowed: a file on disk"));
  EXPECT_THAT(refusal("[no-such-program]"), HasSubstr("cannot be started: no-such-program: No such file"));
  const auto script = folder_.write("script", "#!/no/such/python -u\n");
  fs::permissions(script, fs::perms::owner_all);
  EXPECT_THAT(refusal("['" + script.string() + "']"), HasSubstr("its interpreter /no/such/python does not exist"));
  EXPECT_THAT(refusal("[sh, -c, 'head -c 16 <&3 >/dev/null; printf %01000d 0 >&3; exec sleep 100']"),
              HasSubstr("sent '0000000000000000' instead of a frame"));
}

TEST_F(Plugins, InTheSandboxHaveNoNetwork) {
  const auto file = scenario("  - {name: network, extract: {module: hostile, params: {how: network}}}\n",
                             "plugins: ['" + places::plugin("hostile").string() + "']\n");
  ASSERT_EQ(run({"run", file, "--out", folder_ / "a", "--quiet", "--no-figures"}).code, 3);
  EXPECT_THAT(end_of("network").message, HasSubstr("reached the network"));
  ASSERT_EQ(run({"run", file, "--out", folder_ / "b", "--sandbox", "--quiet", "--no-figures"}).code, 3);
  EXPECT_EQ(end_of("good", "b").status, "ok");
  const std::string manifest = read(folder_ / "b/manifest.json");
  EXPECT_THAT(manifest, testing::Not(HasSubstr("bubblewrap"))) << "no program is in the sandbox";
  if (manifest.find("network namespace (libraries)") == std::string::npos)
    GTEST_SKIP() << "namespaces are not allowed here";
  EXPECT_THAT(end_of("network", "b").message, HasSubstr("Network is unreachable"));
}

/// The names of the checks that a module of the library of wrong ones fails.
std::vector<std::string> failed_checks(const std::string& module, const std::string& out) {
  std::vector<std::string> names;
  const std::size_t at = out.find("\n" + module + " (");  // of the first module there is nothing before
  std::istringstream lines(out.substr(at == std::string::npos ? 0 : at + 1));
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line) && line.starts_with("  "))
    if (line.starts_with("  FAIL  ")) names.push_back(line.substr(8));
  return names;
}

TEST_F(Plugins, ConformPassesGoodModulesAndNamesTheBrokenChecksOfWrongOnes) {
  const auto outcome = run({"module", "conform", "--plugin", places::plugin("wrong")});
  EXPECT_EQ(outcome.code, 1) << outcome.err;
  // Each is a line through all returns, which is not an extractor for a room: what it fails without its fault is known.
  const auto with = [](std::vector<std::string> names) { return testing::IsSupersetOf(names); };
  EXPECT_THAT(failed_checks("remembers", outcome.out), with({"TheAnswerIsTheSameTwiceAndTheScanUntouched"}));
  EXPECT_THAT(failed_checks("reverses", outcome.out),
              with({"AClockwiseScannerGivesTheSameWallWithTheSensorOnItsLeft"}));
  EXPECT_THAT(failed_checks("counts", outcome.out), with({"ANoiseFreeWallIsOneLine"}));
  EXPECT_THAT(failed_checks("few_beams", outcome.out), with({"TenAndAHundredThousandBeamsAreAnswered"}));
  EXPECT_THAT(failed_checks("empty", outcome.out),
              with({"AScanWithoutBeamsHasNoLines", "AScanWithoutReturnsHasNoLines"}));
  EXPECT_THAT(failed_checks("reverses", outcome.out),
              testing::Not(testing::Contains("TheAnswerIsTheSameTwiceAndTheScanUntouched")));
  const auto good = run({"module", "conform", "--plugin", places::plugin("my_lines")});
  EXPECT_EQ(good.code, 0) << good.out;
  for (const std::string name : {"my_lines_c", "point_matcher_c"}) {
    const auto in_c = run({"module", "conform", "--program", places::plugin("my_lines").parent_path() / name});
    EXPECT_EQ(in_c.code, 0) << in_c.out;
  }
}

TEST_F(Plugins, ConformPassesAGoodModuleOfEachKindAndNamesTheBrokenCheckOfAWrongOne) {
  const auto outcome = run({"module", "conform", "--plugin", places::plugin("wrong_kinds")});
  EXPECT_EQ(outcome.code, 1) << outcome.err;
  for (const std::string good : {"leaves", "collects", "unites"}) {
    EXPECT_THAT(outcome.out, HasSubstr(good + " ("));
    EXPECT_THAT(failed_checks(good, outcome.out), testing::IsEmpty()) << good << "\n" << outcome.out;
  }
  using testing::ElementsAre;
  EXPECT_THAT(failed_checks("believes", outcome.out),
              ElementsAre("AScanWithoutReturnsDoesNotMatch", "TheMotionBetweenTwoScansOfARoomIsFound"));
  EXPECT_THAT(failed_checks("leaves_one_out", outcome.out), testing::Contains("OneScanStaysWhereItIs"));
  EXPECT_THAT(failed_checks("drifts", outcome.out), ElementsAre("TheSameScansGiveTheSameMap"));
  EXPECT_THAT(failed_checks("keeps_the_first", outcome.out), ElementsAre("TheOrderOfTheSegmentsDoesNotMatter"));
}

/// The package of `cmake --install`, a build outside of the source tree, and a run.
TEST_F(Plugins, AreBuiltOutsideOfTheSourceTreeWithTheInstalledPackage) {
  if (kSanitized)
    GTEST_SKIP() << "the installed package builds without sanitizers, and a library must have them as well";
  const std::string build = fs::path(places::program()).parent_path().string();
  const std::string prefix = folder_ / "prefix", out = folder_ / "build";
  const std::string example = places::source_dir() / "examples/plugin";
  const auto shell = [&](const std::string& command) {
    return std::system((command + " >>" + (folder_ / "log").string() + " 2>&1").c_str());
  };
  ASSERT_EQ(shell("cmake --install " + build + " --component modules --prefix " + prefix), 0) << read(folder_ / "log");
  ASSERT_EQ(shell("cmake -S " + example + " -B " + out + " -DCMAKE_PREFIX_PATH=" + prefix), 0) << read(folder_ / "log");
  ASSERT_EQ(shell("cmake --build " + out), 0) << read(folder_ / "log");
  const auto outcome = run({"describe", "--plugin", out + "/libmy_lines.so"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("my_lines (extract)"));
}

}  // namespace
}  // namespace scanbench::app_test
