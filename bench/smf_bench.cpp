// Time of SMF on one 451-beam scan: a 12 m x 9 m room with two boxes, 5 cm noise.
#include <algorithm>
#include <limits>

#include <benchmark/benchmark.h>

#include "core/modules.hpp"
#include "core/registry.hpp"
#include "core/rng.hpp"

namespace scanbench {
namespace {

SensorModel sensor_of(double sigma_m) {
  SensorModel sensor;
  sensor.geometry = ScanGeometry(radians(-135), radians(0.6), 451);
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

void Smf(benchmark::State& state) {
  const double sigma = 0.01 * static_cast<double>(state.range(0));
  const SensorModel sensor = sensor_of(sigma);
  std::vector<std::vector<double>> scans(200);
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
  const auto smf = Registry<LineExtractor>::make("smf", {{"sigma_max_m", 1.2 * sigma}});
  Trace silent;
  std::size_t k = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(smf->extract({sensor, scans[k]}, silent));
    k = (k + 1) % scans.size();
  }
}
BENCHMARK(Smf)->Arg(1)->Arg(5)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace scanbench
