// Which of two values of a metric is better, and the directions that the families declare.
#include "metrics/metric.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <regex>
#include <string>

#include "core/registry.hpp"
#include "core/special_values.hpp"

namespace scanbench::metrics {
namespace {

MetricDescription with(Direction direction, double target = 0.0) {
  return {.metric = "m", .label = "m", .unit = "", .direction = direction, .doc = "", .target = target};
}

TEST(Better, FollowsTheDirection) {
  EXPECT_TRUE(better(with(Direction::lower_is_better), 1, 2));
  EXPECT_FALSE(better(with(Direction::lower_is_better), 2, 1));
  EXPECT_TRUE(better(with(Direction::higher_is_better), 2, 1));
  EXPECT_FALSE(better(with(Direction::higher_is_better), 1, 2));
}

TEST(Better, IsNearerToATargetFromEitherSide) {
  const MetricDescription metric = with(Direction::target, 1.0);
  EXPECT_TRUE(better(metric, 1.0, 0.5));
  EXPECT_TRUE(better(metric, 0.75, 1.5));
  EXPECT_TRUE(better(metric, 1.25, 0.5));
  EXPECT_FALSE(better(metric, 0.5, 1.5));  // equally far
  EXPECT_FALSE(better(metric, 1.5, 0.5));
  EXPECT_EQ(cost(metric, 0.25), 0.75);
}

TEST(Better, IsNeverTrueOfEqualValuesOrWithoutADirection) {
  for (const Direction d :
       {Direction::lower_is_better, Direction::higher_is_better, Direction::target, Direction::neither})
    for (const double v : {-1.0, 0.0, 3.0, kNaN}) EXPECT_FALSE(better(with(d), v, v));
  EXPECT_FALSE(better(with(Direction::neither), 1, 2));
  EXPECT_FALSE(better(with(Direction::neither), 1, kNaN));
}

TEST(Better, AnUndefinedValueIsTheWorst) {
  for (const Direction d : {Direction::lower_is_better, Direction::higher_is_better, Direction::target}) {
    EXPECT_TRUE(better(with(d), 1e9, kNaN));
    EXPECT_TRUE(better(with(d), -1e9, kNaN));
    EXPECT_FALSE(better(with(d), kNaN, 1e9));
  }
}

const MetricDescription& described(const std::vector<MetricDescription>& family, std::string_view metric) {
  for (const MetricDescription& d : family)
    if (d.metric == metric) return d;
  ADD_FAILURE() << metric;
  return family.front();
}

TEST(Direction, IsNotLowerForWhatAMethodThatFindsLessHasLessOf) {
  const auto map_points = Registry<MetricFamily>::make("map_points")->describe();
  const auto map_truth = Registry<MetricFamily>::make("map_truth")->describe();
  const auto siadat1997 = Registry<MetricFamily>::make("siadat1997")->describe();
  // The map of one line for two walls is no better than that of two lines for two walls.
  EXPECT_FALSE(better(described(map_points, "map_lines"), 1, 2));
  EXPECT_FALSE(better(described(map_points, "compression"), 200, 100));
  EXPECT_FALSE(better(described(map_truth, "lines_per_wall"), 0.5, 1.0));
  EXPECT_TRUE(better(described(map_truth, "lines_per_wall"), 1.0, 0.5));
  EXPECT_FALSE(better(described(map_truth, "map_offset"), 0.0, 0.01));
  EXPECT_FALSE(better(described(siadat1997, "s_mean"), 1, 4));
}

// A head or an axis has room for a few words, and a reader must know which metric it is.
TEST(Label, OfEveryMetricIsShortUniqueAndInWords) {
  std::map<std::string, std::string> metric_of_label;
  for (const auto& [name, entry] : Registry<MetricFamily>::all())
    for (const MetricDescription& d : entry.make({})->describe()) {
      EXPECT_FALSE(d.label.empty()) << d.metric;
      EXPECT_LE(d.label.size(), 36u) << d.metric;
      EXPECT_EQ(d.label.find_first_of("_[]"), std::string::npos) << d.metric << ": " << d.label;
      EXPECT_EQ(metric_of_label.emplace(d.label, d.metric).first->second, d.metric) << d.label;
    }
  EXPECT_GT(metric_of_label.size(), 100u);
}

TEST(Direction, HasATargetOnlyWhereItIsTarget) {
  for (const auto& [name, entry] : Registry<MetricFamily>::all())
    for (const MetricDescription& d : entry.make({})->describe()) {
      EXPECT_TRUE(std::isfinite(d.target)) << d.metric;
      if (d.direction != Direction::target) {
        EXPECT_EQ(d.target, 0.0) << d.metric;
      }
    }
}

// A definition is read alone, in a table's head or in `describe`: it names what it is about.
TEST(Definition, StandsAlone) {
  const std::regex reference(
      R"(\bthe same\b(?! wall| scan| frame)|\bboth\b|\ball three\b|\bthat (distance|error|deviation)\b|the other set)");
  for (const auto& [name, entry] : Registry<MetricFamily>::all())
    for (const MetricDescription& d : entry.make({})->describe()) {
      EXPECT_GE(std::ranges::count(d.doc, ' '), 2) << name << ": " << d.metric;
      EXPECT_FALSE(std::regex_search(d.doc, reference)) << name << ": " << d.metric << ": " << d.doc;
    }
}

// A share has no unit and is not a ratio to a best value.
TEST(Definition, OfAShareHasNoUnitAndNoTarget) {
  for (const auto& [name, entry] : Registry<MetricFamily>::all())
    for (const MetricDescription& d : entry.make({})->describe()) {
      EXPECT_TRUE(d.is_share || !d.doc.starts_with("share of")) << d.metric;
      if (!d.is_share) continue;
      EXPECT_EQ(d.unit, "") << d.metric;
      EXPECT_NE(d.direction, Direction::target) << d.metric;
    }
}

}  // namespace
}  // namespace scanbench::metrics
