// Time of the optimal extractor on one scan, 270 degrees in 451 or more beams: a 12 m x 9 m room with two boxes.
#include <algorithm>
#include <limits>

#include <benchmark/benchmark.h>

#include "core/modules.hpp"
#include "core/registry.hpp"
#include "core/rng.hpp"

namespace scanbench {
namespace {

SensorModel sensor_of(int beams, double sigma_m) {
  SensorModel sensor;
  sensor.geometry = ScanGeometry(radians(-135), radians(270.0 / (beams - 1)), beams);
  sensor.noise.sigma_m = sigma_m;
  return sensor;
}

// Range to the walls of axis-parallel rectangles.
double cast(const Vec2& origin, const Vec2& d) {
  static constexpr double kBoxes[][4] = {{0, 0, 12, 9}, {3, 2, 4, 3.5}, {8, 5, 10, 6}};
  double best = std::numeric_limits<double>::infinity();
  for (const auto& b : kBoxes)
    for (int axis = 0; axis < 2; ++axis)
      for (int side = 0; side < 2; ++side) {
        const double t = (b[axis + 2 * side] - origin[axis]) / d[axis];
        const double across = origin[1 - axis] + t * d[1 - axis];
        if (t > 0 && across >= b[1 - axis] && across <= b[3 - axis]) best = std::min(best, t);
      }
  return best;
}

void Optimal(benchmark::State& state) {
  const double sigma = 0.01 * static_cast<double>(state.range(1));
  const SensorModel sensor = sensor_of(static_cast<int>(state.range(0)), sigma);
  std::vector<std::vector<double>> scans(state.range(0) > 1000 ? 20 : 200);
  for (std::uint32_t k = 0; k < scans.size(); ++k) {
    CounterRng place(1, RngStream::pose, k);
    const Vec2 origin(0.5 + 2 * place.uniform(), 0.5 + 8 * place.uniform());
    const double yaw = kTwoPi * place.uniform();
    for (int i = 0; i < sensor.geometry.beams(); ++i) {
      const double a = yaw + sensor.geometry.angle(i);
      CounterRng noise(1, RngStream::range, k, static_cast<std::uint32_t>(i));
      scans[k].push_back(cast(origin, {std::cos(a), std::sin(a)}) + sigma * noise.normal());
    }
  }
  const auto optimal = Registry<LineExtractor>::make("optimal");
  Trace silent;
  std::size_t k = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(optimal->extract({sensor, scans[k]}, silent));
    k = (k + 1) % scans.size();
  }
}
BENCHMARK(Optimal)->ArgNames({"beams", "sigma_cm"})->ArgsProduct({{451, 10000}, {1, 5}})->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace scanbench
