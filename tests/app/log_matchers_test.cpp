// Scan matchers on recorded logs: relative errors against the reference poses, beside those of the odometry.
#include <map>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "tests/app/program.hpp"

namespace scanbench::app_test {
namespace {

/// The metrics of optimal_match in a scenario of scenarios/logs.
std::map<std::string, double> errors_in(const Folder& folder, const std::string& scenario) {
  const fs::path file = places::source_dir() / "scenarios/logs" / (scenario + ".yaml");
  const auto made = run({"run", file.string(), "--only", "optimal_match", "--no-figures", "--out", "out", "-q"},
                        {{"SCANBENCH_DATA", places::data_dir().string()}}, folder.path());
  EXPECT_EQ(made.code, 0) << made.err;
  std::map<std::string, double> values;
  std::istringstream rows(read(folder / "out/summary.csv"));
  for (std::string row; std::getline(rows, row);) {
    std::vector<std::string> fields;
    std::istringstream text(row);
    for (std::string field; std::getline(text, field, ',');) fields.push_back(field);
    if (fields.size() > 5 && fields[3].starts_with("rpe_")) values[fields[3]] = std::strtod(fields[5].c_str(), nullptr);
  }
  return values;
}

class LogMatchers : public testing::TestWithParam<const char*> {};

TEST_P(LogMatchers, OptimalMatchIsNearerToTheReferenceThanTheOdometry) {
  const std::string log = std::string("radish-") + GetParam();
  if (!fs::exists(places::data_dir() / log)) GTEST_SKIP() << log << " is not there";
  const Folder folder;
  const auto errors = errors_in(folder, std::string("match_") + GetParam());
  EXPECT_LT(errors.at("rpe_position"), errors.at("rpe_odometry_position"));
  EXPECT_LT(errors.at("rpe_heading"), 0.5 * errors.at("rpe_odometry_heading"));
}

INSTANTIATE_TEST_SUITE_P(All, LogMatchers, testing::Values("intel", "aces", "csail"),
                         [](const auto& log) { return std::string(log.param); });

}  // namespace
}  // namespace scanbench::app_test
