// Matrices of pipelines and scenarios.
#include "harness/results/nightly/status_matrix.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "harness/results/analysis/gates.hpp"
#include "harness/results/document/html_page.hpp"
#include "tests/harness/results/analysis/made_up_runs.hpp"

namespace scanbench::results {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// Two scenarios with the pipelines a and b, and one with c alone.
RunResults three_scenarios(double value_of_b) {
  const auto value = [&](const std::string& pipeline, const std::string&, std::uint64_t seed) {
    return (pipeline == "b" ? value_of_b : 0.9) + 1e-4 * static_cast<double>(seed * seed);
  };
  RunResults all = fixtures::made_up_run({"a", "b"}, {"f1"}, 5, value);
  for (const auto& [scenario, pipelines] :
       {std::pair{"hall", std::vector<std::string>{"a", "b"}}, std::pair{"maze", std::vector<std::string>{"c"}}})
    for (auto& cell : fixtures::made_up_run(pipelines, {"f1"}, 5, value).cells) {
      cell.key.scenario = scenario;
      all.cells.push_back(cell);
    }
  return all;
}

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

TEST(StatusMatrix, HasATablePerGroupOfScenariosWithTheSamePipelines) {
  const Gates gates(study::GateSpec{{{"f1", 0.01}}});
  RunResults now = three_scenarios(0.7);
  for (auto& cell : now.cells)  // spread, so that the change can be tested
    if (cell.key.pipeline == "b") cell.rows[0].value += 1e-3 * static_cast<double>(cell.key.seed);
  now.cells.back().status = "crashed";
  now.cells.back().rows.clear();
  const Comparison comparison = compare(three_scenarios(0.8), now, gates);
  const std::string html = to_html(status_matrices(now, comparison, rank_methods(now.cells, {}), "report.html"));
  EXPECT_EQ(count_of(html, "<table>"), 1U);
  EXPECT_EQ(count_of(html, "class=\"chips\""), 1U);  // maze has its own pipelines
  EXPECT_EQ(count_of(html, "▼ 1 worse"), 2U);        // b in room and hall
  EXPECT_EQ(count_of(html, "<td class=\"worse"), 2U);
  EXPECT_EQ(count_of(html, "= same<"), 2U);
  EXPECT_EQ(count_of(html, "✗ 1 cell failed"), 1U);
  EXPECT_THAT(html, HasSubstr("f1 -0.097"));  // 0.8 -> 0.7 + the mean of 1e-3 .. 5e-3
  EXPECT_THAT(html, HasSubstr("f1 0.901"));   // of a, which is the same
  EXPECT_THAT(html, HasSubstr("href=\"report.html#hall\""));
  EXPECT_THAT(html, Not(HasSubstr(">–<")));  // no group is partly empty
}

TEST(StatusMatrix, ShowsWhatIsMissing) {
  const Gates gates(study::GateSpec{{{"f1", 0.01}}});
  const RunResults before = three_scenarios(0.8);
  RunResults now = before;
  std::erase_if(now.cells, [](const CellResults& cell) { return cell.key.pipeline == "b"; });
  const std::string html = to_html(status_matrices(now, compare(before, now, gates), {}, ""));
  EXPECT_EQ(count_of(html, "∅ 5 cells missing"), 2U);
  EXPECT_THAT(html, Not(HasSubstr("href")));
  EXPECT_TRUE(status_matrices(RunResults{}, Comparison{}, {}, "").empty());
}

}  // namespace
}  // namespace scanbench::results
