// Mean-shift merging of segments: difficult input, post-processing and the trace.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "core/contracts/mean_shift_trace.hpp"
#include "core/rng.hpp"
#include "tests/support/merging.hpp"
#include "tests/support/spiral.hpp"
#include "tests/support/trace_recorder.hpp"

namespace scanbench {
namespace {

using support::apart;
using support::line;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();

MergeResult merge(const std::vector<MapLine>& lines, const ParamSet& params = {},
                  const std::vector<Vec2>& points = {}) {
  return support::merge("mean_shift", lines, params, points);
}

const ParamSet kStrict{{"labelling", std::string("strict")}, {"split_length_sigma", 1000.0}};

int clusters(const std::vector<int>& labels) {
  return *std::max_element(labels.begin(), labels.end()) + 1;
}

TEST(MeanShift, AnswersBadInputWithAStatusAndDropsWhatItCannotUse) {
  const MergeResult nothing = merge({});
  EXPECT_EQ(nothing.status, Status::converged);
  EXPECT_TRUE(nothing.map.lines.empty());

  const MergeResult useless = merge({line(1, 1, 1, 1), line(kNotANumber, 0, 1, 0), line(0, 0, kInfinity, 0),
                                     line(0, 0, 1e300, 0), line(-1e308, 0, 1e308, 0)},
                                    {{"split_length_sigma", 1e300}});
  EXPECT_EQ(useless.status, Status::degenerate);
  EXPECT_TRUE(useless.map.lines.empty());
  EXPECT_EQ(useless.labels, std::vector<int>(5, -1));

  const MergeResult mixed = merge({line(1, 1, 1, 1), line(0, 0, 1, 0), line(0, kNotANumber, 1, 0)});
  EXPECT_EQ(mixed.status, Status::converged);
  ASSERT_EQ(mixed.map.lines.size(), 1U);
  EXPECT_EQ(mixed.labels, (std::vector<int>{-1, 0, -1}));

  MapLine strange = line(0, 0, 1, 0);
  strange.covariance.setConstant(kNotANumber);
  EXPECT_EQ(merge({strange, strange, line(0, 0, 1, 0)}).map.lines.size(), 1U);
}

TEST(MeanShift, TreatsDirectionsZeroAndPiAsOne) {
  const MergeResult r =
      merge({line(0, 0, 1, 0), line(1, 0, 0, 0), line(0, 1e-12, 1, -1e-12), line(0, -1e-12, 1, 1e-12)});
  ASSERT_EQ(r.map.lines.size(), 1U);
  EXPECT_LT(apart(r.map.lines[0].segment, {{0, 0}, {1, 0}}), 1e-9);
}

TEST(MeanShift, RefusesASigmaThatIsNotPositiveOrCutsTheInputToDust) {
  EXPECT_THROW(Registry<SegmentMerger>::make("mean_shift", {{"sigma_m", 0.0}}), ParamError);
  EXPECT_THROW(Registry<SegmentMerger>::make("mean_shift", {{"sigma_m", -1.0}}), ParamError);
  EXPECT_THROW(Registry<SegmentMerger>::make("mean_shift", {{"h_deg_per_m", 200.0}}), ParamError);
  EXPECT_THROW(merge({line(0, 0, 1000, 0)}, {{"sigma_m", 1e-9}}), ParamError);
  EXPECT_THROW(merge({line(0, 0, 9e8, 0)}), ParamError);
  EXPECT_THROW(merge({line(5e7, 0, 5e7 + 0.3, 0)}), ParamError);
  try {
    merge({line(0, 0, 1000, 0)}, {{"sigma_m", 1e-9}});
  } catch (const ParamError& e) {
    EXPECT_EQ(e.param(), "sigma_m");
    EXPECT_NE(std::string(e.what()).find("1000 m"), std::string::npos) << e.what();
  }
  const MergeResult coarse = merge({line(0, 0, 1, 0), line(7, 3, 8, 3.1)}, {{"sigma_m", 1e6}, {"join", false}});
  EXPECT_EQ(coarse.status, Status::converged);
  EXPECT_EQ(clusters(coarse.cluster2), 1);
  EXPECT_EQ(coarse.map.lines.size(), 2U);  // one cluster, but their projections do not overlap
}

TEST(MeanShift, ErasesOnlyShortLinesThatPointsDoNotSupport) {
  const std::vector<MapLine> lines{line(0, 0, 2, 0), line(0, 5, 0.4, 5), line(0, 9, 0.4, 9)};
  std::vector<Vec2> points{{kNotANumber, 0}, {kInfinity, 1e300}};
  for (int k = 0; k < 12; ++k) points.emplace_back(0.4 * (k + 0.5) / 12, 5.01);  // 30 per metre
  for (int k = 0; k < 9; ++k) points.emplace_back(0.4 * (k + 0.5) / 9, 9.01);    // 22.5 per metre
  for (int k = 0; k < 9; ++k) points.emplace_back(0.4 * (k + 0.5) / 9, 9.06);    // too far away
  for (int k = 0; k < 9; ++k) points.emplace_back(0.41 + 0.01 * k, 9.0);         // past the end
  EXPECT_EQ(merge(lines).map.lines.size(), 3U);
  const MergeResult r = merge(lines, {}, points);
  ASSERT_EQ(r.map.lines.size(), 2U);
  EXPECT_EQ(std::count(r.labels.begin(), r.labels.end(), -1), 1);
  EXPECT_EQ(r.labels[2], -1);
  EXPECT_EQ(merge(lines, {{"erase_unsupported", false}}, points).map.lines.size(), 3U);
}

TEST(MeanShift, JoinsAbuttingPiecesUnlessToldNotTo) {
  // A wall that turns by 3 degrees: too far apart along for one cluster, a gap of 5 cm.
  const double turn = radians(3.0);
  const std::vector<MapLine> lines{line(0, 0, 1, 0), line(1.05, 0, 1.05 + std::cos(turn), std::sin(turn))};
  ParamSet join = kStrict;
  join["join"] = false;
  ASSERT_EQ(merge(lines, join).map.lines.size(), 2U);
  join["join"] = true;
  const MergeResult r = merge(lines, join);
  ASSERT_EQ(r.map.lines.size(), 1U);
  EXPECT_NEAR(r.map.lines[0].segment.length(), 2.05, 0.01);
  EXPECT_EQ(r.map.lines[0].members, 2);
  join["join_angle_deg"] = 2.0;
  EXPECT_EQ(merge(lines, join).map.lines.size(), 2U);
  // The two sides of a thin wall stay two.
  EXPECT_EQ(merge({line(0, 0, 2, 0), line(2, 0.1, 0, 0.1)}).map.lines.size(), 2U);
}

TEST(MeanShift, TrimsShortOvershootsAtIntersections) {
  const std::vector<MapLine> corner{line(0, 0, 2.1, 0), line(2, -0.15, 2, 3), line(1, -1, 1, 1)};
  const MergeResult plain = merge(corner);
  ASSERT_EQ(plain.map.lines.size(), 3U);
  const MergeResult r = merge(corner, {{"trim", true}});
  ASSERT_EQ(r.map.lines.size(), 3U);
  const auto nearest = [&](const Segment& s) {
    double d = kInfinity;
    for (const MapLine& l : r.map.lines) d = std::min(d, apart(l.segment, s));
    return d;
  };
  EXPECT_LT(nearest({{0, 0}, {2, 0}}), 1e-6);
  EXPECT_LT(nearest({{2, 0}, {2, 3}}), 1e-6);
  EXPECT_LT(nearest({{1, -1}, {1, 1}}), 1e-6);  // no overshoot: a crossing
}

TEST(MeanShift, LeavesATraceThatFiguresCanBeDrawnFrom) {
  const auto lines = support::spiral();
  support::TraceRecorder recorder("merge");
  const auto merger = Registry<SegmentMerger>::make("mean_shift", {{"split_length_sigma", 10.0}});
  const MergeResult traced = merger->merge({lines, {}}, recorder.trace);
  Trace silent;
  const MergeResult plain = merger->merge({lines, {}}, silent);
  ASSERT_EQ(traced.map.lines.size(), plain.map.lines.size());
  for (std::size_t k = 0; k < plain.map.lines.size(); ++k)
    EXPECT_EQ(traced.map.lines[k].segment, plain.map.lines[k].segment);

  const auto points = recorder.rows<mean_shift::JointSpaceRow>();
  ASSERT_EQ(points.size(), 300U);  // figure 1: 300 points for 300 segments
  EXPECT_EQ(recorder.rows<mean_shift::ClusterRow>().size(), 300U);
  EXPECT_EQ(recorder.rows<mean_shift::ProjectionRow>().size(), 300U);
  EXPECT_EQ(recorder.rows<mean_shift::Mode1Row>().size(), 300U);
  EXPECT_EQ(recorder.rows<mean_shift::Mode2Row>().size(), recorder.rows<mean_shift::Kernel2Row>().size());
  EXPECT_EQ(recorder.rows<mean_shift::IntervalRow>().size(), plain.map.lines.size());
  const auto counts = recorder.rows<mean_shift::CountsRow>();
  ASSERT_EQ(counts.size(), 1U);
  EXPECT_EQ(counts[0].lines, 300);
  EXPECT_EQ(counts[0].map_lines, static_cast<int>(plain.map.lines.size()));

  const auto expect_a_climb_from_every_point = [&](const auto& steps) {
    std::set<int> climbed;
    for (const auto& step : steps) {
      climbed.insert(step.piece);
      if (step.step > 0) continue;
      const auto& start = points.at(static_cast<std::size_t>(step.piece));
      EXPECT_NEAR(step.x_m, start.x_m, 1e-12);
      EXPECT_NEAR(step.y_m, start.y_m, 1e-12);
    }
    EXPECT_EQ(climbed.size(), 300U);
  };
  expect_a_climb_from_every_point(recorder.rows<mean_shift::TrajectoryRow<1>>());
  expect_a_climb_from_every_point(recorder.rows<mean_shift::TrajectoryRow<2>>());
}

}  // namespace
}  // namespace scanbench
