// Shared libraries as modules: good ones, those of another build, and ones that do all that a module must not do.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <map>
#include <sstream>

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
  Folder folder_;
};

TEST_F(Plugins, TheReadmesModuleInALibraryGivesTheLinesOfTheProgramsInCAndPython) {
  const std::string library = places::plugin("my_lines");
  const bool python = std::system("python3 -c pass >/dev/null 2>&1") == 0;
  const std::string c = library.substr(0, library.rfind('/')) + "/my_lines_c";
  std::string pipelines =
      "  - {name: library, extract: {module: my_lines}}\n  - {name: c, extract: {program: ['" + c + "']}}\n";
  if (python)
    pipelines += "  - {name: python, extract: {program: [python3, '" +
                 (places::source_dir() / "examples/programs/my_lines.py").string() + "']}}\n";
  const auto outcome = run({"run", scenario(pipelines), "--plugin", library, "--out", folder_ / "a", "--quiet"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const std::string lines = read(folder_ / "a/cells/room/library/1/lines.csv");
  EXPECT_EQ(std::count(lines.begin(), lines.end(), '\n'), 6);
  const auto numbers = [](const std::string& csv) {
    std::string text = csv.substr(csv.find('\n') + 1);
    std::ranges::replace(text, ',', ' ');
    std::istringstream words(text);
    return std::vector<double>{std::istream_iterator<double>(words), {}};
  };
  const std::vector<double> expected = numbers(lines);
  EXPECT_EQ(expected.size(), 60u);  // five frames, twelve columns
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
  EXPECT_THAT(run({"describe", "--plugin", folder_.write("text.so", "hello")}).err, HasSubstr("is no shared library"));
  EXPECT_THAT(run({"describe", "--plugin", places::plugin("fast_math")}).err,
              HasSubstr("changes the floating-point arithmetic"));
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
                                          {"kill_parent", {"crashed", "sent a signal to this program"}},
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
  for (const auto& [how, end] : expected) {
    EXPECT_EQ(end_of(how).status, end.status) << how << ": " << end_of(how).message;
    EXPECT_THAT(end_of(how).message, HasSubstr(end.message)) << how;
  }
  EXPECT_EQ(end_of("good").status, "ok");
  // The kernel does not limit the processes of root, unless there is a control group for it.
  const std::string manifest = read(folder_ / "a/manifest.json");
  if (manifest.find("RLIMIT_NPROC") != std::string::npos || manifest.find("pids.max") != std::string::npos) {
    EXPECT_THAT(end_of("fork_storm").message, HasSubstr("no process after "));
  }
  // What left its session is gone too.
  const std::string message = end_of("daemon").message;
  const int daemon = std::stoi(message.substr(message.find("daemon ") + 7));
  EXPECT_NE(kill(daemon, 0), 0) << "process " << daemon << " has outlived its cell";

  const auto alone = scenario("");
  ASSERT_EQ(run({"run", alone, "--out", folder_ / "b", "--quiet", "--no-figures"}).code, 0);
  EXPECT_EQ(read(folder_ / "a/cells/room/good/1/lines.csv"), read(folder_ / "b/cells/room/good/1/lines.csv"));
  EXPECT_EQ(read(folder_ / "a/cells/room/good/1/metrics.csv"), read(folder_ / "b/cells/room/good/1/metrics.csv"));
}

/// The names of the checks that a module of the library of wrong ones fails.
std::vector<std::string> failed_checks(const std::string& module, const std::string& out) {
  std::vector<std::string> names;
  std::istringstream lines(out.substr(out.find(module + " (extract")));
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line) && line.starts_with("  "))
    if (line.starts_with("  FAIL  ")) names.push_back(line.substr(8));
  return names;
}

TEST_F(Plugins, ConformPassesGoodModulesAndNamesTheBrokenChecksOfWrongOnes) {
  const auto outcome = run({"conform", "--plugin", places::plugin("wrong")});
  EXPECT_EQ(outcome.code, 1) << outcome.err;
  // Each is a line through all returns, which is no extractor for a room: what it fails without its fault is known.
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
  const auto good = run({"conform", "--plugin", places::plugin("my_lines")});
  EXPECT_EQ(good.code, 0) << good.out;
  const auto in_c = run({"conform", "--program", places::plugin("my_lines").parent_path() / "my_lines_c"});
  EXPECT_EQ(in_c.code, 0) << in_c.out;
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
