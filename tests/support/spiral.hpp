// Data set "Spiral" (Lakaemper 2009, figures 1-3), a reconstruction, because the paper prints no coordinates. An
// Archimedean spiral of 30 segments, and copies of it slightly rotated and shifted against each other.
#pragma once

#include <array>
#include <vector>

#include "core/geometry/pose2.hpp"
#include "core/line_map.hpp"

namespace scanbench::support {

inline constexpr std::array<std::array<double, 2>, 31> kSpiralVertices{{
    {0.4000, 0.0000},   {-0.2434, 0.6222},  {-0.8442, -0.1577}, {-0.2545, -0.9826}, {0.7667, -0.8579},
    {1.2710, 0.0489},   {0.9206, 1.0318},   {-0.0238, 1.4854},  {-1.0342, 1.1967},  {-1.6386, 0.3340},
    {-1.6038, -0.7206}, {-0.9682, -1.5650}, {0.0292, -1.9185},  {1.0629, -1.6873},  {1.8318, -0.9573},
    {2.1363, 0.0591},   {1.9128, 1.0972},   {1.2287, 1.9101},   {0.2487, 2.3220},   {-0.8128, 2.2557},
    {-1.7411, 1.7358},  {-2.3623, 0.8715},  {-2.5701, -0.1729}, {-2.3370, -1.2122}, {-1.7104, -2.0739},
    {-0.7976, -2.6241}, {0.2563, -2.7842},  {1.2937, -2.5376},  {2.1676, -1.9262},  {2.7610, -1.0398},
    {3.0000, -0.0000},
}};

/// Rotation about the origin in degrees, then the shift in metres.
inline constexpr std::array<std::array<double, 3>, 10> kSpiralCopies{{
    {0.1257, -0.0040, 0.0192},
    {0.1049, -0.0161, 0.0108},
    {1.3040, 0.0284, -0.0211},
    {-1.2654, -0.0187, 0.0012},
    {-2.3250, -0.0066, -0.0374},
    {-0.7323, -0.0163, -0.0095},
    {0.4116, 0.0313, -0.0039},
    {1.3665, -0.0200, 0.0105},
    {0.9035, 0.0028, -0.0223},
    {-0.9217, -0.0137, 0.0066},
}};

inline std::vector<MapLine> spiral_copy(const Pose2& pose) {
  std::vector<MapLine> lines;
  for (std::size_t k = 0; k + 1 < kSpiralVertices.size(); ++k) {
    const Segment s{{kSpiralVertices[k][0], kSpiralVertices[k][1]},
                    {kSpiralVertices[k + 1][0], kSpiralVertices[k + 1][1]}};
    lines.push_back({.segment = pose * s});
  }
  return lines;
}

/// The 300 segments, copy by copy.
inline std::vector<MapLine> spiral() {
  std::vector<MapLine> lines;
  for (const auto& [rotation_deg, x, y] : kSpiralCopies) {
    const auto copy = spiral_copy(Pose2(x, y, radians(rotation_deg)));
    lines.insert(lines.end(), copy.begin(), copy.end());
  }
  return lines;
}

}  // namespace scanbench::support
