// Time of the optimal extractor on one scan of 451 and of 10 000 beams, with noise of 1 and 5 cm.
#include <benchmark/benchmark.h>

#include "bench/room.hpp"
#include "core/modules.hpp"
#include "core/registry.hpp"

namespace scanbench {
namespace {

void Optimal(benchmark::State& state) {
  const int beams = static_cast<int>(state.range(0));
  const ScanSet scans = bench::room_scans(beams, 0.01 * static_cast<double>(state.range(1)), beams > 1000 ? 20 : 200);
  const auto optimal = Registry<LineExtractor>::make("optimal");
  Trace silent;
  std::size_t k = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(optimal->extract(scans.scan(k), silent));
    k = (k + 1) % scans.frames.size();
  }
}
BENCHMARK(Optimal)->ArgNames({"beams", "sigma_cm"})->ArgsProduct({{451, 10000}, {1, 5}})->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace scanbench
