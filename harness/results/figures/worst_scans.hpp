// The scans on which each pipeline of a run did worst.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "harness/results/analysis/run_results.hpp"

namespace scanbench::results {

struct WorstScan {
  runs::CellKey key;
  std::size_t frame = 0;
  double f1 = 0.0;
  int found = 0;  ///< lines that are true
  int false_lines = 0;
  int missed = 0;
  int split = 0;
  int unjudged = 0;      ///< lines too short to judge
  std::string sketch{};  ///< inline SVG
};

struct PipelineWorst {
  std::string pipeline;
  std::vector<WorstScan> scans;  ///< worst first (scan_error.hpp)
};

/// Of every pipeline whose cells have a scans.csv (metric family `segments`), the `count` worst scans over all
/// scenarios and seeds; of a scan that several seeds repeat, the worst. Pipelines are in the order of the results.
/// Throws ConfigError for damaged files.
std::vector<PipelineWorst> worst_scans(const std::filesystem::path& run, const RunResults& results, std::size_t count);

}  // namespace scanbench::results
