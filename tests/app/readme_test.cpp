// README's example of a scenario, run as it stands there. (Its example of a module is part of the conformance tests.)
#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/app/program.hpp"

namespace scanbench::app_test {
namespace {

/// The first block of README in this language.
std::string block(const std::string& language) {
  const std::string text = read(places::source_dir() / "README.md");
  const std::string fence = "```" + language + "\n";
  const auto begin = text.find(fence);
  if (begin == std::string::npos) return "";
  const auto first = begin + fence.size();
  return text.substr(first, text.find("```", first) - first);
}

/// The commands of a block of lines "./scanbench ...  # what it does", without ./scanbench and what it does.
std::vector<Args> commands(const std::string& text) {
  std::vector<Args> all;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("./scanbench ")) continue;
    std::istringstream words(line.substr(12, line.find(" #") - 12));
    Args& args = all.emplace_back();
    for (std::string word; words >> word;) args.push_back(word);
  }
  return all;
}

TEST(Readme, EveryCommandOfWhatElseItDoesRunsAsWritten) {
  const std::string text = read(places::source_dir() / "README.md");
  const auto section = text.find("## What else it does");
  const auto first = text.find("```\n", section) + 4;
  const Folder folder;
  fs::create_directory_symlink(places::source_dir() / "scenarios", folder / "scenarios");
  ASSERT_EQ(run({"run", "scenarios/abcdef.yaml", "-q"}, {}, folder.path()).code, 0);  // the first of "Two commands"
  const auto all = commands(text.substr(first, text.find("```", first) - first));
  EXPECT_GE(all.size(), 10U);
  for (Args args : all) {
    const bool is_long = std::ranges::any_of(args, [](const auto& arg) {
      return arg.find("suites/") != std::string::npos || arg.ends_with("figures.yaml");
    });
    if (is_long) args = {"check", args[1]};  // a run takes minutes
    const auto outcome = run(args, {}, folder.path());
    const bool ended_well = outcome.code == 0 || (args[0] == "compare" && outcome.code == 1);
    EXPECT_TRUE(ended_well) << args[0] << " " << args[1] << ": " << outcome.code << "\n" << outcome.err;
    EXPECT_NE(outcome.out, "") << args[0];
  }
}

TEST(Readme, ReplaysALogOfOnesOwn) {
  const Folder folder;
  folder.write("mine.yaml", block("yaml"));
  // A corridor of 4 m: two walls beside the robot, nothing ahead within the range of the scanner.
  std::string log;
  for (int scan = 0; scan < 3; ++scan) {
    log += "FLASER 181";
    for (int degree = -90; degree <= 90; ++degree) {
      const double range = 2.0 / std::max(1e-3, std::abs(std::sin(degree * 3.14159265358979 / 180.0)));
      log += " " + std::to_string(std::min(range, 81.83));
    }
    const std::string pose = std::to_string(0.5 * scan) + " 0 0";
    log += " " + pose + " " + pose + " " + std::to_string(scan) + " robot " + std::to_string(scan) + "\n";
  }
  folder.write("corridor.log", log);
  const auto outcome = run({"run", "mine.yaml"}, {}, folder.path());
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  const std::string lines = read(folder / "out/mine/cells/mine/iepf/1/lines.csv");
  EXPECT_EQ(std::count(lines.begin(), lines.end(), '\n'), 1 + 3 * 2) << lines;
  EXPECT_TRUE(fs::exists(folder / "out/mine/report.html"));
}

/// A cheap rotating scanner in a square room of 4 m: 355 to 364 readings a turn.
std::string turning_scanner() {
  std::string log;
  for (int scan = 0; scan < 10; ++scan) {
    const int n = 355 + scan;
    for (int i = 0; i < n; ++i) {
      const double a = (-180.0 + 360.0 * i / n) * 3.14159265358979 / 180.0;
      log += (i == 0 ? "" : ",") + std::to_string(2.0 / std::max(std::abs(std::cos(a)), std::abs(std::sin(a))));
    }
    log += "\n";
  }
  return log;
}

TEST(Replay, WithoutASensorReadingsAreTakenToHaveErrorsOfACentimetre) {
  const Folder folder;
  std::string turn;  // in a square room of 4 m, from corner to corner
  for (int degree = -135; degree < 225; ++degree) {
    const double a = degree * 3.14159265358979 / 180.0;
    const double error = degree % 2 == 0 ? 0.008 : -0.008;
    turn += (turn.empty() ? "" : ",") +
            std::to_string(error + 2.0 / std::max(std::abs(std::cos(a)), std::abs(std::sin(a))));
  }
  folder.write("turns.csv", turn + "\n" + turn + "\n");
  folder.write("mine.yaml",
               "schema: 1\nrecording: {log: turns.csv, format: csv, first_angle_deg: -135, step_deg: 1}\n"
               "pipelines:\n  - {name: lines, extract: {module: optimal}}\nmetrics: [siadat1997]\n");
  const auto check = run({"check", "mine.yaml"}, {}, folder.path());
  EXPECT_THAT(check.out + check.err, testing::HasSubstr("taken to have errors of 0.01 m"));
  ASSERT_EQ(run({"run", "mine.yaml", "--out", "out"}, {}, folder.path()).code, 0);
  const std::string lines = read(folder / "out/cells/mine/lines/1/lines.csv");
  EXPECT_EQ(std::count(lines.begin(), lines.end(), '\n'), 1 + 2 * 4) << lines;
}

TEST(Replay, ScansWhoseNumberOfBeamsChangesGiveTheWallsOfTheRoom) {
  const Folder folder;
  folder.write("turns.csv", turning_scanner());
  for (const std::string angles : {"resampled"}) {
    folder.write(
        "mine.yaml",
        "schema: 1\nrecording: {log: turns.csv, format: csv, first_angle_deg: -180, span_deg: 360, "
        "angles: " +
            angles +
            "}\npipelines:\n  - {name: iepf, extract: {module: iepf, params: {threshold_m: 0.08, min_points: 6}}}\n"
            "metrics: [siadat1997, map_points]\nfigures: [scan_overlay, lines_world]\n");
    const auto outcome = run({"run", "mine.yaml", "--out", angles}, {}, folder.path());
    ASSERT_EQ(outcome.code, 0) << outcome.err << outcome.out;
    // A reading is moved by at most half a degree, 2.5 cm: every line is on one of the four walls, which are 2 m away.
    std::istringstream rows(read(folder / (angles + "/cells/mine/iepf/1/lines.csv")));
    std::set<std::pair<int, int>> seen;  // frame and wall
    std::string row;
    std::getline(rows, row);
    while (std::getline(rows, row)) {
      std::replace(row.begin(), row.end(), ',', ' ');
      std::istringstream fields(row);
      int frame = 0, line = 0;
      double x1 = 0, y1 = 0, x2 = 0, y2 = 0, rho = 0, alpha = 0;
      fields >> frame >> line >> x1 >> y1 >> x2 >> y2 >> rho >> alpha;
      const double quarter_turns = alpha / (3.14159265358979 / 2);
      EXPECT_NEAR(rho, 2.0, 0.06) << row;
      EXPECT_NEAR(quarter_turns, std::round(quarter_turns), 0.05) << row;
      seen.emplace(frame, (static_cast<int>(std::round(quarter_turns)) + 4) % 4);
    }
    EXPECT_EQ(seen.size(), 10U * 4U);
    // The whole chain again from the files.
    EXPECT_EQ(run({"score", angles}, {}, folder.path()).code, 0);
    EXPECT_EQ(run({"export", angles, "--format", "carmen"}, {}, folder.path()).code, 0);
  }
  folder.write("same.yaml",
               "schema: 1\nrecording: {log: turns.csv, format: csv, first_angle_deg: -180, span_deg: 360}\n"
               "pipelines:\n  - {name: iepf, extract: {module: iepf, params: {threshold_m: 0.08, min_points: 6}}}\n");
  const auto refused = run({"check", "same.yaml"}, {}, folder.path());
  EXPECT_EQ(refused.code, 2);
  EXPECT_THAT(refused.err, testing::HasSubstr("turns.csv:2:1: 356 ranges"));
}

}  // namespace
}  // namespace scanbench::app_test
