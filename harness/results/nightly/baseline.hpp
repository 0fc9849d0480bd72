// Baselines: small files in the repository with the accepted values of a suite's gates. They are moved on purpose only,
// with a reason, so that a slow drift cannot slip in. All are kept: baselines/<suite>/0001.json, 0002.json, ...
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "harness/results/analysis/gates.hpp"
#include "harness/results/analysis/run_results.hpp"

namespace scanbench::results {

struct Baseline {
  std::filesystem::path file;
  std::string accepted;  ///< UTC, ISO 8601
  std::string reason;
  RunResults results;  ///< one row per judged metric and cell, subject "all" or kMeanOfSubjects
};

/// What a baseline keeps of a run: of every gate and watched metric, one value per cell (comparison.hpp says which). A
/// run is compared with a baseline after the same reduction.
RunResults gate_values(const RunResults& results, const Gates& gates);

/// The files of a suite's baselines, by number; none if the folder does not exist. Other files there do not count.
/// Throws ConfigError for a suite that is no FolderName.
std::vector<std::filesystem::path> baseline_files(const std::filesystem::path& baselines, const std::string& suite);

/// Those of these files whose values mean what today's do (docs/formats.md, schema of baselines), in their order.
/// Throws ConfigError for a file that is not a JSON object.
std::vector<std::filesystem::path> current_baselines(const std::vector<std::filesystem::path>& files);

/// Throws ConfigError, naming the file, if it is not a baseline, or an old one whose values meant something else.
Baseline load_baseline(const std::filesystem::path& file);

/// Writes the next file of the suite, never over another one, also if several processes accept at once: per pipeline
/// and metric the seeds' values, their median and the 95 % interval of their mean, and per pipeline the hash of its
/// values. Returns its path. Throws ConfigError if a cell is missing or not ok, if the reason is empty, if the run has
/// overrides of --set, and if nothing differs from the newest baseline.
std::filesystem::path accept_baseline(const std::filesystem::path& baselines, const std::string& suite,
                                      const RunResults& results, const Gates& gates, const std::string& reason);

}  // namespace scanbench::results
