// Time of force field simulation. The forces of one iteration are compared with the plain double loop and with a
// nanoflann k-d tree, cut at the same four standard deviations. Whole alignments of 60 scans of about 200 resampled
// points take 100 iterations.
//
// The maps: 60 scans of an arena of 12 m x 8.4 m with panels, from random places, each pose wrong by some centimetres;
// and 400 scans of 361 points of an office floor of 60 m x 36 m, for one iteration alone.
#include <benchmark/benchmark.h>

#include <sys/resource.h>

#include <cmath>
#include <nanoflann.hpp>
#include <utility>
#include <vector>

#include "algorithms/align/ffs/body.hpp"
#include "algorithms/align/ffs/force_field.hpp"
#include "core/modules.hpp"
#include "core/registry.hpp"
#include "core/rng.hpp"
#include "tests/support/aligning.hpp"
#include "tests/support/plain_forces.hpp"

namespace {

using namespace scanbench;
using align::ffs::Field;
using align::ffs::FieldPoints;
using align::ffs::PointForce;

constexpr int kScans = 60;
constexpr double kSigmaStart = 0.3;
constexpr double kSigmaEnd = 0.05;
constexpr int kIterations = 100;

std::vector<Segment> arena() {
  std::vector<Segment> walls = support::box(0, 0, 12, 8.4);
  for (const Segment& s : support::polygon({{5.1, 3.6}, {5.1, 4.8}, {6.9, 4.8}, {6.9, 3.6}})) walls.push_back(s);
  CounterRng rng(3, RngStream::pose);
  for (int k = 0; k < 14; ++k) {
    const Vec2 p(0.5 + 11 * rng.uniform(), 0.5 + 7 * rng.uniform());
    const double turn = (k % 2) * kPi / 2 + 0.05 * rng.normal();
    walls.push_back({p, p + 1.2 * Vec2(std::cos(turn), std::sin(turn))});
  }
  return walls;
}

struct Scans {
  support::ScanSeries series;
  std::vector<Pose2> given;
};

const Scans& scans() {
  static const Scans made = [] {
    Scans result;
    const std::vector<Segment> walls = arena();
    CounterRng rng(5, RngStream::pose);
    for (int k = 0; k < kScans; ++k) {
      const Pose2 truth(0.6 + 10.8 * rng.uniform(), 0.6 + 7.2 * rng.uniform(), kTwoPi * rng.uniform());
      result.series.add_extracted(support::with_noise(
          support::cast(support::fan_sensor(221, radians(110)), walls, truth), 0.01, 7, static_cast<std::uint32_t>(k)));
      result.given.push_back(truth * Pose2(0.1 * rng.normal(), 0.1 * rng.normal(), 0.03 * rng.normal()));
    }
    return result;
  }();
  return made;
}

constexpr double kResampleM = 0.04;  // about 200 points per scan

FieldPoints field_points() {
  FieldPoints points;
  const auto observations = scans().series.observations();
  for (std::size_t b = 0; b < observations.size(); ++b) {
    const align::ffs::Body body = align::ffs::body_of(observations[b], kResampleM);
    for (std::size_t k = 0; k < body.points.size(); ++k)
      points.add(scans().given[b] * body.points[k], scans().given[b].rotate(body.directions[k]), 1.0,
                 static_cast<int>(b));
  }
  return points;
}

/// Rooms of 6 m x 6 m with doors of 1 m in all inner walls.
std::vector<Segment> office() {
  constexpr double kSide = 6.0, kDoor = 1.0;
  constexpr int kColumns = 10, kRows = 6;
  std::vector<Segment> walls = support::box(0, 0, kColumns * kSide, kRows * kSide);
  const auto wall_with_door = [&](const Vec2& from, const Vec2& along) {
    walls.push_back({from, from + 0.5 * (kSide - kDoor) * along});
    walls.push_back({from + 0.5 * (kSide + kDoor) * along, from + kSide * along});
  };
  for (int column = 0; column < kColumns; ++column)
    for (int row = 0; row < kRows; ++row) {
      const Vec2 corner(column * kSide, row * kSide);
      if (column > 0) wall_with_door(corner, {0, 1});
      if (row > 0) wall_with_door(corner, {1, 0});
    }
  return walls;
}

/// The readings themselves, with the directions of their walls: 400 scans of 361 points.
const FieldPoints& office_points() {
  static const FieldPoints made = [] {
    FieldPoints points;
    const std::vector<Segment> walls = office();
    CounterRng rng(11, RngStream::pose);
    for (int k = 0; k < 400; ++k) {
      const Pose2 truth(0.5 + 59 * rng.uniform(), 0.5 + 35 * rng.uniform(), kTwoPi * rng.uniform());
      const Pose2 given = truth * Pose2(0.05 * rng.normal(), 0.05 * rng.normal(), 0.01 * rng.normal());
      const auto scan = support::cast(support::fan_sensor(361, kTwoPi), walls, truth);
      const auto view = scan.view();
      for (int i = 0; i < view.beams(); ++i) {
        const int wall = scan.ids[static_cast<std::size_t>(i)];
        if (wall < 0) continue;
        const Vec2 along = truth.inverse().rotate(walls[static_cast<std::size_t>(wall)].direction());
        points.add(given * view.point(i), given.rotate(along), 1.0, k);
      }
    }
    return points;
  }();
  return made;
}

double sigma_of(const benchmark::State& state) {
  return static_cast<double>(state.range(0)) / 1000.0;
}

void report_memory(benchmark::State& state) {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  state.counters["peak_MiB"] = static_cast<double>(usage.ru_maxrss) / 1024.0;
}

/// Relative root mean square error of forces against the plain double loop.
double relative_error(const std::vector<PointForce>& forces, const std::vector<Vec2>& exact) {
  double error = 0.0, size = 0.0;
  for (std::size_t k = 0; k < exact.size(); ++k) {
    error += (forces[k].force - exact[k]).squaredNorm();
    size += exact[k].squaredNorm();
  }
  return std::sqrt(error / size);
}

void ours(benchmark::State& state) {
  const FieldPoints points = field_points();
  const Field field{sigma_of(state), 4.0};
  std::vector<PointForce> forces;
  for (auto _ : state) {
    point_forces(points, field, forces);
    benchmark::DoNotOptimize(forces.data());
  }
  const std::vector<Vec2> exact = support::plain_forces(points, field.sigma, field.soft());
  state.counters["relative_rms_error"] = relative_error(forces, exact);
  state.counters["points"] = static_cast<double>(points.size());
  report_memory(state);
}

void ours_400_scans(benchmark::State& state) {
  const FieldPoints& points = office_points();
  const Field field{sigma_of(state), 4.0};
  std::vector<PointForce> forces;
  for (auto _ : state) {
    point_forces(points, field, forces);
    benchmark::DoNotOptimize(forces.data());
  }
  state.counters["points"] = static_cast<double>(points.size());
  report_memory(state);
}

/// Brute force for every 200th of the points: all of them would take minutes. It says how wrong the forces are.
void plain_400_scans_sampled(benchmark::State& state) {
  constexpr std::size_t kStride = 200;
  const FieldPoints& points = office_points();
  const Field field{sigma_of(state), 4.0};
  std::vector<PointForce> forces, sampled;
  point_forces(points, field, forces);
  for (std::size_t k = 0; k < forces.size(); k += kStride) sampled.push_back(forces[k]);
  std::vector<Vec2> exact;
  for (auto _ : state) {
    exact.clear();
    for (std::size_t k = 0; k < points.size(); k += kStride)
      exact.push_back(support::plain_force_on(k, points, field.sigma, field.soft()));
  }
  state.counters["relative_rms_error"] = relative_error(sampled, exact);
}

void plain_double_loop(benchmark::State& state) {
  const FieldPoints points = field_points();
  for (auto _ : state) benchmark::DoNotOptimize(support::plain_forces(points, sigma_of(state)).data());
}

struct Cloud {
  const std::vector<Vec2>& points;
  std::size_t kdtree_get_point_count() const { return points.size(); }
  double kdtree_get_pt(std::size_t i, std::size_t d) const { return points[i][static_cast<Eigen::Index>(d)]; }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

/// Forces from a new k-d tree, cut at four standard deviations, in double precision.
void tree_forces(const FieldPoints& points, double sigma, std::vector<Vec2>& forces) {
  using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Cloud>, Cloud, 2, std::size_t>;
  const Cloud cloud{points.at};
  const Tree tree(2, cloud, nanoflann::KDTreeSingleIndexAdaptorParams(10));
  const nanoflann::SearchParams unsorted(32, 0.0F, false);
  std::vector<std::pair<std::size_t, double>> found;
  const double peak = 1.0 / (sigma * std::sqrt(kTwoPi)), exponent = -0.5 / (sigma * sigma);
  forces.assign(points.size(), Vec2::Zero());
  for (std::size_t v = 0; v < points.size(); ++v) {
    found.clear();
    tree.radiusSearch(points.at[v].data(), 16.0 * sigma * sigma, found, unsorted);
    for (const auto& [u, squared] : found) {
      if (points.body[u] == points.body[v] || squared == 0) continue;
      const double m = peak * std::exp(exponent * squared) * points.weight[u] * points.weight[v] *
                       std::abs(points.direction[u].dot(points.direction[v]));
      forces[v] += m / std::sqrt(squared) * (points.at[u] - points.at[v]);
    }
  }
}

void nanoflann_cut_4(benchmark::State& state) {
  const FieldPoints points = field_points();
  std::vector<Vec2> forces;
  for (auto _ : state) {
    tree_forces(points, sigma_of(state), forces);
    benchmark::DoNotOptimize(forces.data());
  }
}

void nanoflann_400_scans(benchmark::State& state) {
  const FieldPoints& points = office_points();
  std::vector<Vec2> forces;
  for (auto _ : state) {
    tree_forces(points, sigma_of(state), forces);
    benchmark::DoNotOptimize(forces.data());
  }
}

/// What the k-d tree would take for the forces of the same schedule: the scans stay where they are.
void nanoflann_schedule(benchmark::State& state) {
  const FieldPoints points = field_points();
  std::vector<Vec2> forces;
  for (auto _ : state)
    for (int t = 0; t < kIterations; ++t)
      tree_forces(points, kSigmaStart * std::pow(kSigmaEnd / kSigmaStart, t / (kIterations - 1.0)), forces);
}

void whole(benchmark::State& state, const char* module) {
  const auto aligner = Registry<Aligner>::make(module, {{"resample_m", kResampleM},
                                                        {"sigma_start_m", kSigmaStart},
                                                        {"sigma_end_m", kSigmaEnd},
                                                        {"cooling_iterations", std::int64_t{kIterations}},
                                                        {"max_iterations", std::int64_t{kIterations}}});
  const auto observations = scans().series.observations();
  Trace silent;
  for (auto _ : state) benchmark::DoNotOptimize(aligner->align(observations, scans().given, silent));
  report_memory(state);
}

BENCHMARK(ours)->Arg(300)->Arg(50)->Unit(benchmark::kMillisecond);
BENCHMARK(nanoflann_cut_4)->Arg(300)->Arg(50)->Unit(benchmark::kMillisecond);
BENCHMARK(ours_400_scans)->Arg(300)->Unit(benchmark::kMillisecond);
BENCHMARK(nanoflann_400_scans)->Arg(300)->Unit(benchmark::kMillisecond);
BENCHMARK(plain_400_scans_sampled)->Arg(300)->Iterations(1)->Unit(benchmark::kMillisecond);
BENCHMARK(plain_double_loop)->Arg(300)->Iterations(1)->Unit(benchmark::kMillisecond);
BENCHMARK(nanoflann_schedule)->Iterations(1)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(whole, ffs, "ffs")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(whole, virtual_scans, "virtual_scans")->Unit(benchmark::kMillisecond);

}  // namespace
