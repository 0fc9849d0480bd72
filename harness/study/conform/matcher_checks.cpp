// Checks of scan matchers. The scans have no lines: what a matcher does with those is its own affair.
#include "harness/study/conform/matcher_checks.hpp"

#include <cmath>
#include <string>
#include <vector>

#include "core/special_values.hpp"
#include "harness/study/conform/scenes.hpp"

namespace scanbench::study::conform {
namespace {

using Matchers = Subject<ScanMatcher>;

constexpr double kFarthest_m = 0.05;  // of a pose from the true one, in a room with 1 cm noise

OwnedScan room(const Pose2& pose, std::uint32_t frame = 0) {
  auto walls = box(-3, -2, 4, 2.5);
  for (const Segment& s : polygon({{2, 1}, {2.6, 1.2}, {2.4, 1.8}, {1.8, 1.6}})) walls.push_back(s);
  return with_noise(cast(ring_sensor(360), walls, pose), 0.01, 5, frame);
}

Match match(const ScanMatcher& module, const OwnedScan& a, const OwnedScan& b, const Pose2& guess, Findings& findings) {
  const auto none = [](const OwnedScan& scan) { return ScanLines{{}, std::vector<int>(scan.ranges.size(), -1)}; };
  const ScanLines of_a = none(a), of_b = none(b);
  const Scan first = a.view(), second = b.view();
  Trace silent;
  const Match result = module.match({first, of_a}, {second, of_b}, guess, silent);
  const Pose2& pose = result.reference_from_current;
  findings.expect(pose.translation().allFinite() && std::isfinite(pose.yaw()), "the pose is not finite");
  findings.expect(result.covariance.allFinite(), "the covariance is not finite");
  findings.expect((result.covariance - result.covariance.transpose()).norm() <= 1e-9 * (1 + result.covariance.norm()),
                  "the covariance is not symmetric");
  findings.expect(result.status != Status::no_match || pose == guess,
                  "the status is no_match, and the pose not the guess");
  return result;
}

void match_no_returns(const Matchers& subject, Findings& findings) {
  const auto module = subject.make({});
  const Pose2 guess(0.1, 0.2, 0.3);
  const OwnedScan full = room({});
  for (const double reading : {kInf, -kInf, kNaN, 0.0, -1.0}) {
    const OwnedScan empty = constant_scan(ring_sensor(360), reading);
    for (const auto& [a, b] : {std::pair(empty, empty), std::pair(full, empty), std::pair(empty, full)})
      findings.expect(match(*module, a, b, guess, findings).status == Status::no_match,
                      "a scan without returns matches");
  }
}

void match_odd_readings(const Matchers& subject, Findings& findings) {
  const auto module = subject.make({});
  for (const double reading : {kNaN, kInf, -kInf, 0.0, -1.0, 1e300, 1e-300}) {
    OwnedScan a = room({}), b = room({0.1, 0.05, 0.03}, 1);
    for (std::size_t i = 0; i < 360; i += 3) a.ranges[i] = b.ranges[i + 1] = reading;
    match(*module, a, b, {}, findings);
  }
}

void match_moves(const Matchers& subject, Findings& findings) {
  const auto module = subject.make({});
  std::uint32_t frame = 0;
  for (const Pose2& step : {Pose2(0, 0, 0), Pose2(0.1, 0.05, 0.03), Pose2(-0.08, 0.1, -0.05)}) {
    const Match found = match(*module, room({}), room(step, ++frame), {}, findings);
    const Pose2 off = step.inverse() * found.reference_from_current;
    findings.expect(found.status != Status::no_match, "two scans of a room do not match");
    findings.expect(
        off.translation().norm() < kFarthest_m && std::fabs(off.yaw()) < kFarthest_m,
        "the pose is off by " + std::to_string(off.translation().norm()) + " m, " + std::to_string(off.yaw()) + " rad");
  }
}

void match_again(const Matchers& subject, Findings& findings) {
  const auto module = subject.make({});
  const OwnedScan a = room({}), b = room({0.1, 0.05, 0.03}, 1);
  const Match first = match(*module, a, b, {}, findings);
  const auto same = [&](const Match& other) {
    return first.status == other.status && first.reference_from_current == other.reference_from_current &&
           first.covariance == other.covariance;
  };
  findings.expect(same(match(*module, a, b, {}, findings)), "the same scans have another pose the second time");
  match(*module, b, room({0.3, 0, 0}, 2), {}, findings);
  findings.expect(same(match(*module, a, b, {}, findings)), "the same scans have another pose after other scans");
  findings.expect(same(match(*subject.make({}), a, b, {}, findings)), "a second instance finds another pose");
}

}  // namespace

const std::vector<Check<ScanMatcher>>& matcher_checks() {
  static const std::vector<Check<ScanMatcher>> checks{
      {"AScanWithoutReturnsDoesNotMatch", match_no_returns},
      {"FaultyReadingsAmongGoodOnesAreAnswered", match_odd_readings},
      {"TheMotionBetweenTwoScansOfARoomIsFound", match_moves},
      {"TheAnswerIsTheSameTwice", match_again},
  };
  return checks;
}

}  // namespace scanbench::study::conform
