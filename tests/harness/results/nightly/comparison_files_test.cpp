// A comparison as JSON, JUnit XML, Markdown and for a terminal.
#include "harness/results/nightly/comparison_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/special_values.hpp"
#include "harness/results/nightly/comparison_tables.hpp"
#include "tests/harness/results/analysis/made_up_runs.hpp"

namespace scanbench::results {
namespace {

using fixtures::f1_run;
using ::testing::HasSubstr;
using ::testing::Not;

Gates gate_of_f1() {
  return Gates(study::GateSpec{{{"f1", 0.01}}});
}

Comparison worse_and_broken() {
  RunResults now = f1_run({0.5, 0.41, 0.3});
  now.cells[2].status = "crashed";
  now.cells[2].message = "</testcase><script>alert(1)</script> | \x1b[31m";
  now.cells[2].rows.clear();
  return compare(f1_run({0.9, 0.8, 0.7}), now, gate_of_f1());
}

TEST(ComparisonFiles, JsonHasEveryPair) {
  const auto json = nlohmann::json::parse(comparison_json(worse_and_broken()));
  EXPECT_EQ(json.at("verdict"), "FAIL");
  EXPECT_EQ(json.at("broken").at(0).at("after"), "crashed");
  const auto& change = json.at("changes").at(0);
  EXPECT_EQ(change.at("metric"), "f1");
  EXPECT_EQ(change.at("pairs").size(), 2U);
  EXPECT_EQ(change.at("pairs").at(1).at("after"), 0.41);
  const auto lost =
      nlohmann::json::parse(comparison_json(compare(f1_run({0.9, 0.8}), f1_run({0.9, kNaN}), gate_of_f1())));
  EXPECT_TRUE(lost.at("changes").at(0).at("pairs").at(1).at("after").is_null());
}

TEST(ComparisonFiles, JunitCountsAFailurePerGateAndCell) {
  const std::string xml = comparison_junit(worse_and_broken());
  EXPECT_THAT(xml, HasSubstr("<testsuite name=\"scanbench\" tests=\"2\" failures=\"2\" errors=\"0\">"));
  EXPECT_THAT(xml, HasSubstr("classname=\"room.iepf\" name=\"f1\"><failure message=\"f1 of iepf in room fell"));
  RunResults crashed = f1_run({0.5, 0.41, 0.3});
  crashed.cells[2].status = "crashed";
  EXPECT_THAT(comparison_junit(compare(crashed, crashed, gate_of_f1())), HasSubstr("tests=\"2\" failures=\"1\""));
  const std::string good = comparison_junit(compare(f1_run({0.9}), f1_run({0.9}), gate_of_f1()));
  EXPECT_THAT(good, HasSubstr("tests=\"1\" failures=\"0\" errors=\"0\""));
  const std::string missing = comparison_junit(compare(f1_run({0.9, 0.8}), f1_run({0.9}), gate_of_f1()));
  EXPECT_THAT(missing, HasSubstr("errors=\"1\""));
  EXPECT_THAT(missing, HasSubstr("<error message=\"the cell is missing\"/>"));
}

TEST(ComparisonTables, CountNewCellsAndListTheFirst) {
  const auto zero = [](const auto&, const auto&, std::uint64_t) { return 0.5; };
  const std::vector<std::string> many{"iepf", "b", "c", "d", "e", "f", "g", "h"};
  const Comparison c = compare(f1_run({0.5, 0.5}), fixtures::made_up_run(many, {"f1"}, 4, zero), gate_of_f1());
  ASSERT_EQ(c.added.size(), 2U + 7U * 4U);
  const auto table = completeness_table(c);
  ASSERT_TRUE(table.has_value());
  ASSERT_EQ(table->rows.size(), 6U);
  EXPECT_EQ(table->rows[0].heads[2], "iepf");
  EXPECT_EQ(table->rows[0].heads[3], "2 seeds, first 3");
  EXPECT_EQ(table->rows[5].heads[1], "3 more pipelines");
  EXPECT_EQ(table->rows[5].heads[3], "12 cells");
}

TEST(ComparisonDocument, ListsWhatDiffersBelowTheVerdict) {
  Comparison comparison = compare(f1_run({0.9}), f1_run({0.9}), gate_of_f1());
  comparison.differing = {"program: a -> b"};
  EXPECT_THAT(to_markdown(comparison_document(comparison)), HasSubstr("**\n\nWhat differs:\n\n- program: a -&gt; b\n"));
  EXPECT_THAT(to_terminal(comparison_document(comparison), false),
              HasSubstr(".\n\nWhat differs:\n  program: a -> b\n"));
  EXPECT_THAT(to_terminal(comparison_document(comparison), false), Not(HasSubstr("Equal to the bit")));
  EXPECT_THAT(to_terminal(comparison_document(comparison, true), false), HasSubstr("\n\nEqual to the bit\n"));
}

TEST(ComparisonFiles, TextOfModulesCannotLeaveItsPlace) {
  const Comparison comparison = worse_and_broken();
  const std::string xml = comparison_junit(comparison);
  EXPECT_THAT(xml, Not(HasSubstr("<script>")));
  EXPECT_THAT(xml, Not(HasSubstr("\x1b")));
  const std::string markdown = to_markdown(comparison_document(comparison));
  EXPECT_THAT(markdown, Not(HasSubstr("<script>")));
  EXPECT_THAT(markdown, HasSubstr("**FAIL: 1 of 1 gate is worse, and 1 cell is no longer ok."));
}

}  // namespace
}  // namespace scanbench::results
