// Equidistant resampling and the moments of a body.
#include "algorithms/align/ffs/body.hpp"

#include <algorithm>
#include <cmath>

namespace scanbench::align::ffs {
namespace {

constexpr double kFarthestM = 1e6;
constexpr double kMostPoints = 4096.0;

bool usable(const Segment& line) {
  const auto near = [](const Vec2& p) { return p.allFinite() && p.cwiseAbs().maxCoeff() <= kFarthestM; };
  return near(line.a) && near(line.b) && line.length() > 0;
}

}  // namespace

void resample(const Segment& line, double step_m, std::vector<Vec2>& points) {
  const int intervals = static_cast<int>(std::clamp(std::ceil(line.length() / step_m), 1.0, kMostPoints - 1.0));
  for (int k = 0; k <= intervals; ++k) points.emplace_back(line.a + (line.b - line.a) * (k / double(intervals)));
}

Body body_of(const Observation& observation, double step_m) {
  Body body;
  for (const LineFeature& line : observation.lines.lines) {
    if (!usable(line.segment)) continue;
    body.lines.push_back(line.segment);
    resample(line.segment, step_m, body.points);
    body.directions.resize(body.points.size(), line.segment.direction());
  }
  if (body.points.empty()) return body;
  for (const Vec2& p : body.points) body.centre += p / body.mass();
  for (const Vec2& p : body.points) {
    const double squared = (p - body.centre).squaredNorm();
    body.inertia += squared;
    body.radius = std::max(body.radius, std::sqrt(squared));
  }
  return body;
}

}  // namespace scanbench::align::ffs
