// Which scans hold each other: by points, and by the sides of a rectangle.
#include "algorithms/align/ffs/meeting.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "algorithms/align/ffs/hypotheses.hpp"

namespace scanbench::align::ffs {
namespace {

constexpr double kStep = 0.1;
constexpr double kReach = 0.05;

const std::vector<Vec2> kCorners{{0, 0}, {2, 0}, {2, 1.2}, {0, 1.2}};

/// The part of a side of the rectangle between these shares of its length.
Segment part(std::size_t side, double from, double to) {
  const Vec2 &a = kCorners[side], &b = kCorners[(side + 1) % 4];
  return {a + from * (b - a), a + to * (b - a)};
}

/// Where scans that show these segments meet, all in one frame, with the rectangle as a hypothesis or without.
Meeting meeting(const std::vector<std::vector<Segment>>& scans, bool rectangle) {
  std::vector<Body> bodies;
  FieldPoints points;
  for (const auto& lines : scans) {
    Body body;
    for (const Segment& line : lines) {
      resample(line, kStep, body.points);
      body.directions.resize(body.points.size(), line.direction());
    }
    for (const Vec2& p : body.points) body.centre += p / body.mass();
    for (const Vec2& p : body.points) body.radius = std::max(body.radius, (p - body.centre).norm());
    for (std::size_t k = 0; k < body.points.size(); ++k)
      points.add(body.points[k], body.directions[k], 1.0, static_cast<int>(bodies.size()));
    bodies.push_back(body);
  }
  HypothesisRules rules;
  rules.resample_m = kStep;
  VirtualScan virtual_scan;
  if (rectangle) virtual_scan = plotted({{Shape::rectangle, kCorners, 1.0, 0}}, rules);
  return meeting_of(bodies, std::vector<Pose2>(bodies.size()), points, virtual_scan, kReach);
}

using Scans = std::vector<std::size_t>;

TEST(Meeting, ScansOfTheSameCornerHoldEachOther) {
  const std::vector<Segment> corner{part(0, 0, 1), part(3, 0, 1)};
  const Meeting found = meeting({corner, corner}, false);
  EXPECT_TRUE(found.groups.together());
  EXPECT_EQ(found.sliding, Scans{});
}

TEST(Meeting, ARectangleOfSidesThatNoTwoScansShareHoldsTheirDirectionsAlone) {
  // Two scans see two sides each. Farther apart, the four sides are those of a larger rectangle.
  const std::vector<std::vector<Segment>> scans{{part(0, 0, 1), part(3, 0, 1)}, {part(1, 0, 1), part(2, 0, 1)}};
  EXPECT_EQ(meeting(scans, false).groups.groups().size(), 2U);
  const Meeting found = meeting(scans, true);
  EXPECT_TRUE(found.groups.together());
  EXPECT_EQ(found.sliding, (Scans{0, 1}));
}

TEST(Meeting, ASideThatTwoScansShareHoldsThemAcrossIt) {
  // Halves of a side do not meet by their points. One shared side leaves the motion along it open, two leave none.
  const std::vector<Segment> first{part(0, 0, 0.45), part(3, 0.55, 1)};
  EXPECT_EQ(meeting({first, {part(0, 0.55, 1), part(1, 0, 1)}}, true).sliding, (Scans{0, 1}));
  const Meeting found = meeting({first, {part(0, 0.55, 1), part(3, 0, 0.45)}}, true);
  EXPECT_TRUE(found.groups.together());
  EXPECT_EQ(found.sliding, Scans{});
}

}  // namespace
}  // namespace scanbench::align::ffs
