// Small worlds for the tests of metrics: scans cast by brute force, lines by hand or from the truth.
#pragma once

#include <cmath>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "core/index.hpp"
#include "core/recording.hpp"
#include "core/registry.hpp"
#include "core/result.hpp"
#include "core/special_values.hpp"
#include "metrics/metric.hpp"

namespace scanbench::test {

/// Observed scans, truth and result of a made-up run.
struct MadeUpRun {
  ScanSet observed;
  Truth truth;
  PipelineResult result;

  metrics::MetricInput input() const { return {observed, &truth, result}; }
  metrics::MetricInput input_without_truth() const { return {observed, nullptr, result}; }
};

/// A run of no frames with this sensor and these walls.
inline MadeUpRun make_run(const ScanGeometry& geometry, std::vector<Wall> walls) {
  MadeUpRun run;
  run.observed.sensor.geometry = geometry;
  run.truth.walls = std::move(walls);
  return run;
}

/// Appends a frame whose beams come from the given walls at the given ranges.
inline void add_frame(MadeUpRun& run, const Pose2& world_from_sensor, std::span<const double> ranges,
                      std::span<const std::int32_t> wall_ids) {
  run.observed.frames.push_back(
      {.stamp_s = 0.0, .ranges = {ranges.begin(), ranges.end()}, .odom_from_sensor = world_from_sensor});
  run.truth.world_from_sensor.push_back(world_from_sensor);
  run.truth.ranges.insert(run.truth.ranges.end(), ranges.begin(), ranges.end());
  run.truth.wall_ids.insert(run.truth.wall_ids.end(), wall_ids.begin(), wall_ids.end());
  run.result.lines.push_back({.lines = {}, .labels = std::vector<int>(ranges.size(), -1)});
}

/// Appends a noise-free frame: for every beam the nearest intersection with all walls, by Cramer's rule.
inline void cast_frame(MadeUpRun& run, const Pose2& world_from_sensor) {
  const ScanGeometry& geometry = run.observed.sensor.geometry;
  std::vector<double> ranges;
  std::vector<std::int32_t> ids;
  for (int i = 0; i < geometry.beams(); ++i) {
    const Vec2 d = world_from_sensor.rotate(geometry.direction(i));
    ranges.push_back(kInf);
    ids.push_back(-1);
    for (std::size_t w = 0; w < run.truth.walls.size(); ++w) {
      const Segment& s = run.truth.walls[w].segment;
      const Vec2 along = s.b - s.a;
      const Vec2 to_a = s.a - world_from_sensor.translation();
      const double det = cross(d, along);
      if (det == 0) continue;
      const double r = cross(to_a, along) / det;
      const double t = cross(to_a, d) / det;
      if (r > 0 && t >= 0 && t <= 1 && r < ranges.back()) {
        ranges.back() = r;
        ids.back() = static_cast<std::int32_t>(w);
      }
    }
  }
  add_frame(run, world_from_sensor, ranges, ids);
}

/// A line of a scan between two points, sensor frame.
inline LineFeature line_between(const Vec2& a, const Vec2& b) {
  LineFeature line;
  line.segment = {a, b};
  line.line = line_through(a, b);
  return line;
}

/// Appends a line supported by the given beams to a frame; returns it for changes.
inline LineFeature& add_line(MadeUpRun& run, std::size_t frame, LineFeature line, const std::vector<int>& beams) {
  ScanLines& lines = run.result.lines[frame];
  for (const int beam : beams) lines.labels[as_index(beam)] = static_cast<int>(lines.lines.size());
  line.points = static_cast<int>(beams.size());
  if (!beams.empty()) {
    line.first_beam = beams.front();
    line.last_beam = beams.back();
  }
  lines.lines.push_back(line);
  return lines.lines.back();
}

inline LineFeature polar_line(double rho, double alpha_deg) {
  LineFeature line;
  line.line = canonical(rho, radians(alpha_deg));
  return line;
}

/// Finds every maximal run of two or more beams of one wall as one exact line.
inline void find_all_lines(MadeUpRun& run, std::size_t frame) {
  const Scan scan = run.observed.scan(frame);
  const auto beams = as_index(scan.beams());
  const auto id = [&](int i) { return run.truth.wall_ids[frame * beams + as_index(i)]; };
  for (int begin = 0, end = 0; begin < scan.beams(); begin = end) {
    std::vector<int> members;
    for (end = begin; end < scan.beams() && id(end) == id(begin); ++end) members.push_back(end);
    if (id(begin) >= 0 && members.size() >= 2)
      add_line(run, frame, line_between(scan.point(begin), scan.point(end - 1)), members);
  }
}

inline std::unique_ptr<metrics::MetricFamily> family(std::string_view name, const ParamSet& params = {}) {
  return Registry<metrics::MetricFamily>::make(name, params);
}

inline std::vector<metrics::MetricRow> evaluate(std::string_view name, const MadeUpRun& run,
                                                const ParamSet& params = {}) {
  return family(name, params)->evaluate(run.input());
}

/// The only row of this metric and subject.
inline metrics::MetricRow row(const std::vector<metrics::MetricRow>& rows, std::string_view metric,
                              std::string_view subject = "all") {
  const metrics::MetricRow* found = nullptr;
  for (const auto& r : rows)
    if (r.metric == metric && r.subject == subject) {
      EXPECT_EQ(found, nullptr) << metric << " of " << subject << " appears twice";
      found = &r;
    }
  if (found == nullptr) {
    ADD_FAILURE() << "no row " << metric << " of " << subject;
    return {};
  }
  return *found;
}

inline void expect_value(const std::vector<metrics::MetricRow>& rows, std::string_view metric, std::string_view subject,
                         double value, std::int64_t count) {
  const metrics::MetricRow r = row(rows, metric, subject);
  EXPECT_NEAR(r.value, value, 1e-12) << metric << " of " << subject;
  EXPECT_EQ(r.count, count) << metric << " of " << subject;
}

inline void expect_undefined(const std::vector<metrics::MetricRow>& rows, std::string_view metric,
                             std::string_view subject = "all") {
  const metrics::MetricRow r = row(rows, metric, subject);
  EXPECT_TRUE(std::isnan(r.value)) << metric << " of " << subject << " is " << r.value;
  EXPECT_EQ(r.count, 0) << metric << " of " << subject;
}

}  // namespace scanbench::test
