// Checks of aligners.
#include "harness/study/conform/aligner_checks.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/special_values.hpp"
#include "harness/study/conform/scenes.hpp"

namespace scanbench::study::conform {
namespace {

using Aligners = Subject<Aligner>;

constexpr double kFarthest = 0.05;  // m and rad: of relative poses from the true ones, in a room with 1 cm noise

Alignment align(const Aligner& module, const Series& series, const std::vector<Pose2>& initial, Findings& findings,
                Trace trace = {}) {
  Alignment result = module.align(series.observations(), initial, trace);
  findings.expect(
      result.world_from_sensor.size() == initial.size(),
      std::to_string(result.world_from_sensor.size()) + " poses for " + std::to_string(initial.size()) + " scans");
  for (const Pose2& pose : result.world_from_sensor)
    findings.expect(pose.translation().allFinite() && std::isfinite(pose.yaw()), "a pose is not finite");
  return result;
}

void align_no_scans(const Aligners& subject, Findings& findings) {
  align(*subject.make({}), {}, {}, findings);
}

void align_one_scan(const Aligners& subject, Findings& findings) {
  const std::vector<Pose2> initial{{3, -1, 0.4}};
  findings.expect(align(*subject.make({}), drive(1), initial, findings).world_from_sensor == initial,
                  "the pose of the only scan is changed");
}

void align_without_returns(const Aligners& subject, Findings& findings) {
  const auto module = subject.make({});
  for (const double reading : {kInf, -kInf, kNaN, 0.0, -1.0}) {
    Series none, some = drive(3);
    for (int k = 0; k < 3; ++k) none.add(constant_scan(ring_sensor(361), reading));
    findings.expect(align(*module, none, stops(3), findings).status != Status::converged,
                    "scans without returns are called aligned");
    some.add(constant_scan(ring_sensor(361), reading));
    align(*module, some, stops(4), findings);
  }
}

void align_odd_readings(const Aligners& subject, Findings& findings) {
  const auto module = subject.make({});
  for (const double reading : {kNaN, kInf, -kInf, 0.0, -1.0}) {
    const Series clean = drive(3);
    Series series;
    for (std::size_t k = 0; k < clean.size(); ++k) {
      OwnedScan scan = clean.scan(k);
      for (std::size_t i = k; i < scan.ranges.size(); i += 3) scan.ranges[i] = reading;
      series.add(scan);
    }
    align(*module, series, stops(3), findings);
  }
}

void true_poses(const Aligners& subject, Findings& findings) {
  const Alignment found = align(*subject.make({}), drive(4), stops(4), findings);
  if (found.world_from_sensor.size() != 4) return;
  for (int k = 1; k < 4; ++k) {
    const auto& poses = found.world_from_sensor;
    const Pose2 relative = poses[0].inverse() * poses[static_cast<std::size_t>(k)];
    const Pose2 off = (stop(0).inverse() * stop(k)).inverse() * relative;
    findings.expect(off.translation().norm() < kFarthest && std::fabs(off.yaw()) < kFarthest,
                    "from the true poses, scan " + std::to_string(k) + " is moved by " +
                        std::to_string(off.translation().norm()) + " m, " + std::to_string(off.yaw()) + " rad");
  }
}

/// The true poses with errors as of odometry.
std::vector<Pose2> believed() {
  std::vector<Pose2> poses = stops(4);
  const std::vector<Pose2> errors{{0, 0, 0}, {0.03, -0.03, 0.02}, {-0.04, 0.03, -0.03}, {0.03, 0.02, 0.03}};
  for (std::size_t k = 0; k < poses.size(); ++k) poses[k] = poses[k] * errors[k];
  return poses;
}

void aligned_poses_move(const Aligners& subject, Findings& findings) {
  const auto module = subject.make({});
  const Series series = drive(4);
  const Pose2 moved(12, -7, 2.2);
  std::vector<Pose2> initial = believed();
  const Alignment here = align(*module, series, initial, findings);
  for (Pose2& pose : initial) pose = moved * pose;
  const Alignment there = align(*module, series, initial, findings);
  findings.expect(here.status == there.status, "in another world frame the status is another one");
  for (std::size_t k = 0; k < std::min(here.world_from_sensor.size(), there.world_from_sensor.size()); ++k) {
    const Pose2 off = (moved * here.world_from_sensor[k]).inverse() * there.world_from_sensor[k];
    findings.expect(off.translation().norm() < 1e-6 && std::fabs(off.yaw()) < 1e-6,
                    "the poses do not move with the world frame");
  }
}

void align_again(const Aligners& subject, Findings& findings) {
  const auto module = subject.make({});
  const Series series = drive(4), fresh = drive(4);
  const std::vector<Pose2> initial = believed();
  const Alignment first = align(*module, series, initial, findings);
  const auto same = [&](const Alignment& other) {
    return first.status == other.status && first.world_from_sensor == other.world_from_sensor;
  };
  for (std::size_t k = 0; k < series.size(); ++k)
    findings.expect(series.scan(k).ranges == fresh.scan(k).ranges, "a scan was changed");
  findings.expect(same(align(*module, series, initial, findings)), "the same scans have other poses the second time");
  align(*module, drive(2), stops(2), findings);
  findings.expect(same(align(*module, series, initial, findings)), "the same scans have other poses after other scans");
  findings.expect(same(align(*subject.make({}), series, initial, findings)), "a second instance finds other poses");
  findings.expect(same(align(*module, series, initial, findings, listening_trace())),
                  "a trace that listens changes the poses");
}

}  // namespace

const std::vector<Check<Aligner>>& aligner_checks() {
  static const std::vector<Check<Aligner>> checks{
      {"NoScansGiveNoPoses", align_no_scans},
      {"OneScanStaysWhereItIs", align_one_scan},
      {"ScansWithoutReturnsAreAnswered", align_without_returns},
      {"FaultyReadingsAmongGoodOnesAreAnswered", align_odd_readings},
      {"TruePosesStay", true_poses},
      {"ThePosesMoveWithTheWorldFrame", aligned_poses_move},
      {"TheAnswerIsTheSameTwice", align_again},
  };
  return checks;
}

}  // namespace scanbench::study::conform
