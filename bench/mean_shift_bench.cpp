// Time of the Gaussian mean shift of all points to their modes. The project's engine is compared with the plain double
// loop and with a nanoflann k-d tree cut at four standard deviations (Lakaemper 2009, section III, brute force and k-d
// tree).
//
// The points are like pieces of the walls of a hallway seen in many scans. They form clusters with a standard deviation
// of 0.35 in every dimension and about 50 points each. The centres are uniform at constant density; the direction is
// periodic with 18 standard deviations. Lengths are in standard deviations of the kernel. A climb ends when its shift
// is below 1e-4.
//
// With --ratios [rounds] the program prints rows of bench/ratios.hpp instead.
#include <benchmark/benchmark.h>

#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nanoflann.hpp>
#include <string>
#include <vector>

#include "algorithms/merge/mean_shift/modes.hpp"
#include "bench/ratios.hpp"
#include "core/index.hpp"
#include "core/modules.hpp"
#include "core/registry.hpp"
#include "core/rng.hpp"

namespace {

using scanbench::as_index;
using scanbench::CounterRng;
using scanbench::RngStream;
using scanbench::merge::find_modes;
using scanbench::merge::Modes;
using scanbench::merge::Vec3;

constexpr double kPeriod = 18.0;
constexpr double kTolerance = 1e-4;
constexpr double kCutoff = 4.0;

std::vector<Vec3> hallway_points(int n) {
  CounterRng rng(17, RngStream::resampling);
  const int clusters = std::max(1, n / 50);
  // 187 neighbours within the cut-off at the modes of 1 654 points, as measured for the paper's hallway.
  const double side = std::sqrt(static_cast<double>(clusters) * 2.0 * 268.0 / kPeriod / 3.0 * 0.9);
  std::vector<Vec3> centres;
  for (int c = 0; c < clusters; ++c)
    centres.emplace_back(side * rng.uniform(), side * rng.uniform(), kPeriod * rng.uniform());
  std::vector<Vec3> points;
  for (int i = 0; i < n; ++i) {
    Vec3 p = centres[as_index(i % clusters)] + 0.35 * Vec3(rng.normal(), rng.normal(), rng.normal());
    p.z() -= kPeriod * std::floor(p.z() / kPeriod);
    points.push_back(p);
  }
  return points;
}

double wrapped_z(double d) {
  if (d > 0.5 * kPeriod) return d - kPeriod;
  return d < -0.5 * kPeriod ? d + kPeriod : d;
}

void ours(benchmark::State& state) {
  const auto points = hallway_points(static_cast<int>(state.range(0)));
  std::size_t modes = 0;
  for (auto _ : state) {
    const Modes result = find_modes(points, {.period = kPeriod, .capture = state.range(1) != 0});
    modes = result.positions.size();
    benchmark::DoNotOptimize(result.mode_of.data());
  }
  state.counters["modes"] = static_cast<double>(modes);
  state.SetComplexityN(state.range(0));
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  state.counters["peak_MiB"] = static_cast<double>(usage.ru_maxrss) / 1024.0;
}

void climb_by_brute_force(const std::vector<Vec3>& points) {
  for (Vec3 t : points) {
    for (int step = 0; step < 5000; ++step) {
      Vec3 sum = Vec3::Zero();
      double mass = 0.0;
      for (const Vec3& p : points) {
        const Vec3 d(p.x() - t.x(), p.y() - t.y(), wrapped_z(p.z() - t.z()));
        const double w = std::exp(-0.5 * d.squaredNorm());
        sum += w * d;
        mass += w;
      }
      const Vec3 shift = sum / mass;
      t += shift;
      if (shift.squaredNorm() < kTolerance * kTolerance) break;
    }
    benchmark::DoNotOptimize(t);
  }
}

void brute_force_double(benchmark::State& state) {
  const auto points = hallway_points(static_cast<int>(state.range(0)));
  for (auto _ : state) climb_by_brute_force(points);
}

/// Points and their periodic images within the cut-off of the seam.
struct Cloud {
  std::vector<Vec3> points;
  std::size_t kdtree_get_point_count() const { return points.size(); }
  double kdtree_get_pt(std::size_t i, std::size_t d) const { return points[i][static_cast<Eigen::Index>(d)]; }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

void climb_by_tree(const std::vector<Vec3>& points) {
  using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Cloud>, Cloud, 3, std::size_t>;
  Cloud cloud{points};
  for (const Vec3& p : points) {
    if (p.z() < kCutoff) cloud.points.emplace_back(p.x(), p.y(), p.z() + kPeriod);
    if (p.z() > kPeriod - kCutoff) cloud.points.emplace_back(p.x(), p.y(), p.z() - kPeriod);
  }
  const Tree tree(3, cloud, nanoflann::KDTreeSingleIndexAdaptorParams(10));
  std::vector<std::pair<std::size_t, double>> found;
  const nanoflann::SearchParams unsorted(32, 0.0F, false);
  for (Vec3 t : points) {
    for (int step = 0; step < 5000; ++step) {
      found.clear();
      tree.radiusSearch(t.data(), kCutoff * kCutoff, found, unsorted);
      Vec3 sum = Vec3::Zero();
      double mass = 0.0;
      for (const auto& [i, squared] : found) {
        const double w = std::exp(-0.5 * squared);
        sum += w * (cloud.points[i] - t);
        mass += w;
      }
      const Vec3 shift = sum / mass;
      t += shift;
      t.z() -= kPeriod * std::floor(t.z() / kPeriod);
      if (shift.squaredNorm() < kTolerance * kTolerance) break;
    }
    benchmark::DoNotOptimize(t);
  }
}

void nanoflann_cut_4(benchmark::State& state) {
  const auto points = hallway_points(static_cast<int>(state.range(0)));
  for (auto _ : state) climb_by_tree(points);
}

/// Prints rows of bench/ratios.hpp.
void print_ratios(int rounds) {
  const auto compare = [&](int n, const std::string& name, void (*climb)(const std::vector<Vec3>&), double limit) {
    const auto points = hallway_points(n);
    const auto count = points.size();
    scanbench::bench::measure("mean shift of " + std::to_string(n) + " points, a point",
                              {{name,
                                [&] {
                                  climb(points);
                                  return count;
                                }},
                               {"find_modes",
                                [&] {
                                  benchmark::DoNotOptimize(find_modes(points, {.period = kPeriod}).mode_of.data());
                                  return count;
                                },
                                limit}},
                              rounds);
  };
  compare(1654, "brute force", climb_by_brute_force, 80);
  compare(100000, "k-d tree", climb_by_tree, 16);
}

/// The whole module on a map of corridors: walls of 1 to 4 m, each seen about 20 times, with an area in proportion to
/// their number.
void merge_module(benchmark::State& state) {
  CounterRng rng(23, RngStream::pose);
  const int n = static_cast<int>(state.range(0));
  const int walls = std::max(1, n / 20);
  const double side = 2.0 * std::sqrt(static_cast<double>(walls));
  std::vector<scanbench::MapLine> lines;
  for (int w = 0; w < walls; ++w) {
    const Vec3 start(side * rng.uniform(), side * rng.uniform(), 0.0);
    const double direction = (rng.bits() % 2 == 0 ? 0.0 : 1.5707963267948966) + 0.02 * rng.normal();
    const double length = 1.0 + 3.0 * rng.uniform();
    for (int k = 0; k < 20; ++k) {
      const double angle = direction + 0.01 * rng.normal();
      const scanbench::Vec2 along(std::cos(angle), std::sin(angle));
      const scanbench::Vec2 a(start.x() + 0.01 * rng.normal(), start.y() + 0.01 * rng.normal());
      lines.push_back(
          {.segment = {a + 0.3 * rng.uniform() * length * along, a + (0.7 + 0.3 * rng.uniform()) * length * along}});
    }
  }
  const auto merger = scanbench::Registry<scanbench::SegmentMerger>::make("mean_shift");
  scanbench::Trace trace;
  std::size_t merged = 0;
  for (auto _ : state) merged = merger->merge({lines, {}}, trace).map.lines.size();
  state.counters["lines"] = static_cast<double>(lines.size());
  state.counters["merged"] = static_cast<double>(merged);
  state.SetComplexityN(state.range(0));
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  state.counters["peak_MiB"] = static_cast<double>(usage.ru_maxrss) / 1024.0;
}

BENCHMARK(brute_force_double)->Arg(1654)->Unit(benchmark::kMillisecond);
BENCHMARK(nanoflann_cut_4)->Arg(1654)->Arg(100000)->Unit(benchmark::kMillisecond);
BENCHMARK(ours)->Args({1654, 1})->Args({1654, 0})->Args({100000, 1})->Args({100000, 0})->Unit(benchmark::kMillisecond);
// Time against the number of points at constant density.
BENCHMARK(ours)
    ->Name("ours_exponent")
    ->ArgsProduct({{2000, 4000, 8000, 16000, 32000, 64000, 128000}, {1}})
    ->Unit(benchmark::kMillisecond)
    ->Complexity([](benchmark::IterationCount n) { return static_cast<double>(n); });
BENCHMARK(merge_module)->Arg(1654)->Arg(100000)->Arg(1000000)->Unit(benchmark::kMillisecond)->Iterations(1);

}  // namespace

int main(int argc, char** argv) {
  if (argc > 1 && std::string(argv[1]) == "--ratios") {
    print_ratios(argc > 2 ? std::max(1, std::atoi(argv[2])) : 5);
    return 0;
  }
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
