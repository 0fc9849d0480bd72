// Time of SMF on one 451-beam scan with noise of 1 and 5 cm.
#include <benchmark/benchmark.h>

#include "bench/room.hpp"
#include "core/modules.hpp"
#include "core/registry.hpp"

namespace scanbench {
namespace {

void Smf(benchmark::State& state) {
  const double sigma = 0.01 * static_cast<double>(state.range(0));
  const ScanSet scans = bench::room_scans(451, sigma, 200);
  const auto smf = Registry<LineExtractor>::make("smf", {{"sigma_max_m", 1.2 * sigma}});
  Trace silent;
  std::size_t k = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(smf->extract(scans.scan(k), silent));
    k = (k + 1) % scans.frames.size();
  }
}
BENCHMARK(Smf)->Arg(1)->Arg(5)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace scanbench
