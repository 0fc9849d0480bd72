// Filters and places the lines of a scan.
#include "algorithms/map/parts/scan_segments.hpp"

#include <algorithm>

#include "core/median.hpp"

namespace scanbench::mapping {
namespace {

constexpr double kFarthestM = 1e6;  // no scanner and no building is larger
constexpr double kShortestLeverM = 1e-3;

bool is_near(const Vec2& p) {
  return p.allFinite() && p.cwiseAbs().maxCoeff() <= kFarthestM;
}

}  // namespace

std::vector<ScanSegment> scan_segments(const Observation& observation, double min_length_m) {
  std::vector<ScanSegment> result;
  const auto& lines = observation.lines.lines;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const Segment& s = lines[i].segment;
    if (!is_near(s.a) || !is_near(s.b) || !(s.length() > 0) || s.length() < min_length_m) continue;
    result.push_back({seen_from_origin(s.a, s.b), lines[i].points, static_cast<int>(i)});
  }
  return result;
}

double total_length(const std::vector<ScanSegment>& segments) {
  double sum = 0.0;
  for (const ScanSegment& s : segments) sum += s.segment.length();
  return sum;
}

double lever_of(const std::vector<ScanSegment>& segments) {
  std::vector<double> distances;
  for (const ScanSegment& s : segments) {
    distances.push_back(s.segment.a.norm());
    distances.push_back(s.segment.b.norm());
  }
  return distances.empty() ? 1.0 : std::max(median(std::move(distances)), kShortestLeverM);
}

std::vector<Segment> placed_at(const Pose2& map_from_sensor, const std::vector<ScanSegment>& segments) {
  std::vector<Segment> placed;
  placed.reserve(segments.size());
  for (const ScanSegment& s : segments) placed.push_back(map_from_sensor * s.segment);
  return placed;
}

}  // namespace scanbench::mapping
