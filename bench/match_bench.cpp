// Time of a match of two consecutive scans, beside a plain ICP on a k-d tree as it is found in tutorials.
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>
#include <nanoflann.hpp>

#include "bench/room.hpp"
#include "core/modules.hpp"
#include "core/registry.hpp"

namespace scanbench {
namespace {

constexpr int kBeams = 451;
constexpr std::uint32_t kPairs = 64;

/// Two scans a step apart, their lines, and a guess that is off by 5 cm per axis and 2 degrees.
struct Pair {
  std::vector<ScanLines> lines;
  Pose2 guess;
};

/// Frames 2k and 2k + 1 are a pair.
struct Pairs {
  ScanSet scans;
  std::vector<Pair> pairs;
};

std::vector<double> ranges_from(const Pose2& pose, const ScanGeometry& geometry, double sigma_m, std::uint32_t frame) {
  std::vector<double> ranges;
  for (int i = 0; i < geometry.beams(); ++i) {
    CounterRng noise(2, RngStream::range, frame, static_cast<std::uint32_t>(i));
    const Vec2 direction = pose.rotate(geometry.direction(i));
    ranges.push_back(bench::range_in_room(pose.translation(), direction) + sigma_m * noise.normal());
  }
  return ranges;
}

Pairs make_pairs(double sigma_m) {
  Pairs result;
  result.scans.sensor.geometry = ScanGeometry(radians(-135), radians(270.0 / (kBeams - 1)), kBeams);
  result.scans.sensor.noise.sigma_m = sigma_m;
  const auto extractor = Registry<LineExtractor>::make("optimal");
  for (std::uint32_t k = 0; k < kPairs; ++k) {
    CounterRng place(2, RngStream::pose, k);
    const auto about = [&](double most) { return most * (2.0 * place.uniform() - 1.0); };
    const Pose2 pose(1.5 + about(1.0), 4.5 + about(3.5), about(kPi)), step(about(0.2), about(0.2), about(0.17));
    const std::array<Pose2, 2> poses{pose, pose * step};
    Pair pair{{},
              {step.x() + std::copysign(0.05, about(1)), step.y() + std::copysign(0.05, about(1)),
               step.yaw() + std::copysign(radians(2), about(1))}};
    for (std::uint32_t i = 0; i < 2; ++i) {
      result.scans.frames.push_back(
          {0.0, ranges_from(poses[i], result.scans.sensor.geometry, sigma_m, 2 * k + i), {}, {}});
      Trace silent;
      pair.lines.push_back(extractor->extract(result.scans.scan(2 * k + i), silent));
    }
    result.pairs.push_back(std::move(pair));
  }
  return result;
}

void match(benchmark::State& state, const std::string& name) {
  const Pairs data = make_pairs(0.01 * static_cast<double>(state.range(0)));
  const auto matcher = Registry<ScanMatcher>::make(name);
  Trace silent;
  std::size_t k = 0;
  for (auto _ : state) {
    const Scan reference = data.scans.scan(2 * k), current = data.scans.scan(2 * k + 1);
    const Pair& pair = data.pairs[k];
    benchmark::DoNotOptimize(matcher->match({reference, pair.lines[0]}, {current, pair.lines[1]}, pair.guess, silent));
    k = (k + 1) % data.pairs.size();
  }
}

struct Cloud {
  std::vector<Vec2> points;
  std::size_t kdtree_get_point_count() const { return points.size(); }
  double kdtree_get_pt(std::size_t i, std::size_t axis) const { return points[i][static_cast<Eigen::Index>(axis)]; }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};
using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Cloud>, Cloud, 2>;

/// Point to point, all pairs within half a metre, until still or 50 iterations.
Pose2 plain_icp(const Scan& reference, const Scan& current, Pose2 pose) {
  const Cloud cloud{valid_points(reference).points};
  const Tree tree(2, cloud, {10});
  const std::vector<Vec2> points = valid_points(current).points;
  for (int iteration = 0; iteration < 50; ++iteration) {
    std::vector<std::pair<Vec2, Vec2>> pairs;
    Vec2 from = Vec2::Zero(), to = Vec2::Zero();
    for (const Vec2& p : points) {
      const Vec2 q = pose * p;
      const std::array<double, 2> query{q.x(), q.y()};
      std::uint32_t index = 0;
      double square = 0.0;
      if (tree.knnSearch(query.data(), 1, &index, &square) == 0 || square > 0.25) continue;
      pairs.emplace_back(q, cloud.points[index]);
      from += q;
      to += cloud.points[index];
    }
    if (pairs.size() < 3) break;
    from /= static_cast<double>(pairs.size());
    to /= static_cast<double>(pairs.size());
    double sine = 0.0, cosine = 0.0;
    for (const auto& [a, b] : pairs) {
      sine += cross(a - from, b - to);
      cosine += (a - from).dot(b - to);
    }
    const Pose2 turn(0, 0, std::atan2(sine, cosine));
    const Pose2 step = Pose2::from_unit(to - turn.rotate(from), {turn.cos(), turn.sin()});
    pose = step * pose;
    if (step.translation().norm() < 1e-5 && std::fabs(turn.sin()) < 1e-6) break;
  }
  return pose;
}

void plain(benchmark::State& state) {
  const Pairs data = make_pairs(0.01 * static_cast<double>(state.range(0)));
  std::size_t k = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(plain_icp(data.scans.scan(2 * k), data.scans.scan(2 * k + 1), data.pairs[k].guess));
    k = (k + 1) % data.pairs.size();
  }
}

BENCHMARK_CAPTURE(match, icp, std::string("icp"))->Arg(1)->Arg(5)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(match, plicp, std::string("plicp"))->Arg(1)->Arg(5)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(match, optimal_match, std::string("optimal_match"))->Arg(1)->Arg(5)->Unit(benchmark::kMicrosecond);
BENCHMARK(plain)->Name("plain nanoflann icp")->Arg(1)->Arg(5)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace scanbench
