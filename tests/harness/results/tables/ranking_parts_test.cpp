// Rankings on pages: what they say of time and of the condition.
#include "harness/results/tables/ranking_parts.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "harness/results/document/html_page.hpp"

namespace scanbench::results {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

MethodRanking ranking_of(const std::vector<std::string>& scenarios) {
  MethodRanking ranking;
  ranking.scenarios = scenarios;
  ranking.condition = "sensor a, range noise 3 cm";
  ranking.quality.metric = "f1";
  ranking.quality.direction = metrics::Direction::higher_is_better;
  const auto add = [&](const char* name, double f1, double seconds, bool on_front) {
    ranking.methods.push_back({.pipeline = name,
                               .quality = {f1, f1, f1, 1},
                               .seconds = seconds,
                               .defined = 1,
                               .cells = 1,
                               .beats_next = {f1, f1, f1, 0},
                               .on_front = on_front});
  };
  add("exact", 0.95, 2e-4, true);
  add("slow", 0.94, 4e-3, false);
  add("quick", 0.9, 1e-5, true);
  return ranking;
}

TEST(RankingParts, SayWhatIsBestForAGivenTimeFromTheFastestOn) {
  EXPECT_EQ(budget_sentence(ranking_of({"room"})),
            "The best for a given time a scan: quick from 10.0 µs (0.900), exact from 200 µs (0.950).");
  MethodRanking one = ranking_of({"room"});
  one.methods.back().on_front = false;
  EXPECT_EQ(budget_sentence(one), "");  // best for any time
}

TEST(RankingParts, StateTheConditionAndFoldManyScenarios) {
  const std::string few = to_html(ranking_blocks({ranking_of({"room", "hall"})}, "report.html"));
  EXPECT_THAT(few, HasSubstr("href=\"report.html#hall\""));
  EXPECT_THAT(few, HasSubstr("Condition: sensor a, range noise 3 cm"));
  EXPECT_THAT(few, HasSubstr("time a scan [µs]"));
  const std::string many = to_html(ranking_blocks({ranking_of({"a", "b", "c", "<d>"})}, ""));
  EXPECT_THAT(many, HasSubstr("<h3>4 scenarios: sensor a, range noise 3 cm</h3>"));
  EXPECT_THAT(many, HasSubstr("<details>"));
  EXPECT_THAT(many, Not(HasSubstr("href")));
  EXPECT_THAT(many, HasSubstr("&lt;d&gt;"));
}

}  // namespace
}  // namespace scanbench::results
