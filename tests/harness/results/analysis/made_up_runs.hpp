// Runs made up in memory, with metric values from a counter-based generator.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/rng.hpp"
#include "harness/results/analysis/run_results.hpp"

namespace scanbench::fixtures {

/// The value of a metric in one cell.
using ValueOf = std::function<double(const std::string& pipeline, const std::string& metric, std::uint64_t seed)>;

/// A run of the scenario "room" with one row, subject "all", per metric and cell.
inline results::RunResults made_up_run(const std::vector<std::string>& pipelines,
                                       const std::vector<std::string>& metrics, std::size_t seeds,
                                       const ValueOf& value) {
  results::RunResults run;
  run.provenance = {"abc", "g++", "", "cpu", "", ""};
  for (const auto& pipeline : pipelines)
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      results::CellResults cell;
      cell.key = {"room", pipeline, seed};
      cell.status = "ok";
      for (const auto& metric : metrics) {
        metrics::MetricRow row;
        row.metric = metric;
        row.subject = "all";
        row.value = value(pipeline, metric, seed);
        cell.rows.push_back(row);
      }
      run.cells.push_back(cell);
    }
  return run;
}

/// A run of the pipeline "iepf" and the metric f1 with these values, one per seed.
inline results::RunResults f1_run(const std::vector<double>& values) {
  return made_up_run({"iepf"}, {"f1"}, values.size(),
                     [&](const auto&, const auto&, std::uint64_t seed) { return values[seed - 1]; });
}

}  // namespace scanbench::fixtures
