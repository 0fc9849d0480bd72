// Published values are checked with the scenario, before anything runs.
#include "harness/study/scenario/published.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "harness/study/scenario/effective.hpp"
#include "harness/study/scenario/scenario_file.hpp"
#include "tests/support/inputs.hpp"

namespace scanbench::study {
namespace {

using testing::HasSubstr;

class Published : public testing::Test {
 protected:
  std::string scenario_text(const std::string& file) const {
    return "schema: 1\nworld: {segments: [[a, 0, 0, 4, 0]]}\nsensor: {preset: ladar_2d30}\n"
           "trajectory: {kind: waypoints, points_m: {A: [1, 1], B: [3, 1]}, scans: 2}\n"
           "pipelines: [{name: lt, extract: {module: line_tracking}, published: LT}]\n"
           "metrics: [borges2000]\npublished: " +
           file + "\n";
  }
  std::string refusal(const std::string& csv) const {
    folder_.write("paper.csv", csv);
    return support::config_refusal([&] { parse_scenario(scenario_text("paper.csv"), folder_.path() / "s.yaml"); });
  }
  const std::string head_ = "metric,subject,method,value,unit\n";
  support::TemporaryFolder folder_;
};

TEST_F(Published, AGoodFileIsTakenWithOrWithoutAByteOrderMark) {
  EXPECT_EQ(refusal(head_ + "n_lines,a,LT,1.28,\neps_rho,a,LT,0.39,cm\n"), "");
  EXPECT_EQ(refusal("\xEF\xBB\xBF" + head_ + "n_lines,a,LT,1.28,\n"), "");
  EXPECT_EQ(refusal(head_ + "n_lines,a,LT,++,rating\n"), "");
}

TEST_F(Published, WrongFilesAreRefusedWhenTheScenarioIsRead) {
  EXPECT_THAT(refusal(""), HasSubstr("paper.csv:1: the column 'metric' is missing"));
  EXPECT_THAT(refusal(head_), HasSubstr("paper.csv: no values"));
  EXPECT_THAT(refusal(head_ + "n_lines,a,LT\n"), HasSubstr("paper.csv:2: found 3 fields"));
  EXPECT_THAT(refusal("metric;subject;method;value;unit\n"), HasSubstr("allowed: commas between the fields"));
  EXPECT_THAT(refusal(head_ + "n_lines,a,LT,many,\n"), HasSubstr("paper.csv:2: value is 'many'"));
  EXPECT_THAT(refusal(head_ + "n_lines,a,LT,,\n"), HasSubstr("paper.csv:2: value is empty"));
  EXPECT_THAT(refusal(head_ + "n_line,a,LT,1,\n"),
              HasSubstr("paper.csv:2: no metric is called 'n_line'; did you mean 'n_lines'?"));
  EXPECT_THAT(refusal(head_ + "n_lines,a,LT,1,furlong\n"),
              HasSubstr("paper.csv:2: unit is 'furlong'; allowed for n_lines"));
  EXPECT_THAT(refusal(head_ + "n_lines,a,LT,1,\nn_lines,a,LT,2,\n"),
              HasSubstr("paper.csv:3: a second value for n_lines, a, LT; the first is in line 2"));
  EXPECT_THAT(refusal(head_ + "n_lines,a,IEPF,1,\n"),
              HasSubstr("pipeline lt reproduces 'LT', which is not a method of"));
}

TEST_F(Published, CentimetresBecomeMetres) {
  const auto values = load_published(folder_.write("p.csv", head_ + "eps_rho,a,LT,0.39,cm\nn_lines,a,LT,++,rating\n"));
  ASSERT_EQ(values.size(), 2U);
  EXPECT_DOUBLE_EQ(values[0].value, 0.0039);
  EXPECT_EQ(values[0].printed, "0.39");
  EXPECT_TRUE(std::isnan(values[1].value));
}

TEST_F(Published, TheEffectiveScenarioKeepsTheVariableAndMakesOtherPathsAbsolute) {
  const auto file = folder_.write("paper.csv", head_ + "n_lines,a,LT,1,\n");
  const auto effective = [&](const std::string& path) {
    return effective_yaml(parse_scenario(scenario_text(path), folder_.path() / "s.yaml"));
  };
  EXPECT_THAT(effective("paper.csv"), HasSubstr("published: \"" + file.string() + "\"\n"));
  const char* earlier = std::getenv("SCANBENCH_DATA");
  const std::string restored = earlier != nullptr ? earlier : "";
  setenv("SCANBENCH_DATA", folder_.path().c_str(), 1);
  EXPECT_THAT(effective("\"${SCANBENCH_DATA}/paper.csv\""), HasSubstr("published: \"${SCANBENCH_DATA}/paper.csv\"\n"));
  if (earlier != nullptr)
    setenv("SCANBENCH_DATA", restored.c_str(), 1);
  else
    unsetenv("SCANBENCH_DATA");
}

}  // namespace
}  // namespace scanbench::study
