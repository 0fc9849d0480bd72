// The figures of a benchmark: F1 against noise, errors against range and against their bound, one scan with the lines
// of every extractor.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "harness/results/analysis/benchmark.hpp"
#include "harness/results/figures/figures.hpp"
#include "harness/study/scenario/benchmark_spec.hpp"

namespace scanbench::results {

/// Draws them from summary.csv, the cells' matches.csv and the example's recording into the folder of the options,
/// pipelines in the order of their rank. Throws ConfigError if files are damaged or cannot be written.
std::vector<FigureFile> draw_benchmark_figures(const runs::RunStore& store,
                                               const std::vector<study::Scenario>& scenarios,
                                               const study::BenchmarkSpec& spec, const FigureOptions& options,
                                               const std::function<void(double, const std::string&)>& progress = {});

}  // namespace scanbench::results
