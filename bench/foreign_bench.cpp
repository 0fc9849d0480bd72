// Wall time of a call of a program: 1081 ranges there, 100 lines and 1081 labels back, without any work. The
// alternative is the same as a module of this process.
#include <benchmark/benchmark.h>

#include <vector>

#include "core/modules.hpp"
#include "core/scan.hpp"
#include "harness/foreign/inspect.hpp"
#include "harness/foreign/program_modules.hpp"

namespace scanbench {
namespace {

constexpr int kBeams = 1081;

class Echo final : public LineExtractor {
 public:
  ScanLines extract(const Scan& scan, Trace&) const override {
    ScanLines found{{}, std::vector<int>(scan.ranges.size(), -1)};
    for (int i = 0; i < 100; ++i) {
      LineFeature line{.segment = {{1, -1}, {1, 1}}, .line = {1, 0}, .covariance = {}};
      line.first_beam = line.last_beam = 10 * i;
      line.points = 1;
      found.labels[static_cast<std::size_t>(10 * i)] = i;
      found.lines.push_back(line);
    }
    return found;
  }
};

void call(benchmark::State& state, const LineExtractor& module) {
  SensorModel sensor;
  sensor.geometry = ScanGeometry(radians(-135), radians(0.25), kBeams);
  const std::vector<double> ranges(kBeams, 2.0);
  Trace silent;
  for (auto _ : state) benchmark::DoNotOptimize(module.extract({sensor, ranges, 0.0}, silent).lines.size());
}

void in_this_process(benchmark::State& state) {
  call(state, Echo());
}
BENCHMARK(in_this_process)->UseRealTime();

void in_a_program(benchmark::State& state) {
  harness::ForeignSource source;
  source.program = {SCANBENCH_ECHO};
  harness::inspect_program(source, false);
  const auto module = harness::run_program<LineExtractor>(source, {}, {});
  call(state, *module);
}
BENCHMARK(in_a_program)->UseRealTime();

}  // namespace
}  // namespace scanbench
