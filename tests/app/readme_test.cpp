// README's example of a scenario, run as it stands there. (Its example of a module is part of the conformance tests.)
#include <algorithm>
#include <cmath>
#include <string>

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

}  // namespace
}  // namespace scanbench::app_test
