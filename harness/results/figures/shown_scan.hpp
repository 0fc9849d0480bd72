// One scan of a run, chosen by number or as the worst one, with the lines that a pipeline found in it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "render/scene.hpp"

namespace scanbench::results {

struct ScanChoice {
  std::string scenario{};               ///< empty: the run's only one
  std::string pipeline{};               ///< empty: the scenario's only one
  std::optional<std::uint64_t> seed{};  ///< none: the scenario's first
  std::string frame = "worst";          ///< a number from 0, or "worst"
};

struct ShownScan {
  std::string name;  ///< of a picture, without ending: <scenario>_<pipeline>_<seed>_scan_<number>
  std::string text;  ///< its values in scans.csv
  std::size_t frame = 0;
  render::Scene scene;
};

/// Reads the run folder. Throws ConfigError for a choice that the run does not have, for a cell that did not end well,
/// and for "worst" where the cell has no scans.csv with an F1.
ShownScan show_scan(const std::filesystem::path& run, const ScanChoice& choice);

/// The same scan in two runs.
struct ShownInBoth {
  ShownScan before;
  ShownScan now;
  bool same_lines = false;
  bool judged = false;  ///< colours are verdicts; else those of pipelines, because there is no truth
};

/// The same scan of a cell in an earlier run and now, in two scenes with the same axes, without legends; the texts are
/// the numbers of right, false, missed and split lines. None if it is not the same scan there. Throws ConfigError as
/// show_scan() does, for both runs.
std::optional<ShownInBoth> show_scan_in_both(const std::filesystem::path& before, const std::filesystem::path& now,
                                             const ScanChoice& choice);

/// The scene as PNG, SVG or PDF, as the ending of the path says; `dpi` is the resolution of PNG. Throws ConfigError for
/// other endings.
std::string picture_bytes(const render::Scene& scene, const std::filesystem::path& path, double dpi = 200.0);

}  // namespace scanbench::results
