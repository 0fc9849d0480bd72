// Catalogues of figures: which scenario, pipelines and parameters make each figure and table of a paper.
//
//   schema: 1
//   about: the figures of five papers                   # optional
//   figures:
//     - name: borges2000_figure1                        # of its files
//       of: Borges & Aldon 2000, figure 1               # the paper's number
//       shows: the simulated environment                # the caption
//       scenario: borges2000.yaml                       # relative to the catalogue
//       figure: {name: environment, params: {frame: 9}} # or only its name
//       pipelines: [iepf, smf]                          # optional, default: all of the scenario
//       seeds: 5                                        # optional, default 1: how many of the scenario's seeds
//       seed: 7                                         # optional: the seed of the scenario that comes first; the same
//                                                       # for all of its figures
//     - {name: borges2000_table1, of: "...", shows: "...", scenario: borges2000.yaml, table: 1, seeds: 5}
//   absent:                                             # what cannot be made
//     - {of: "Siadat et al. 1997, figure 2", why: a photograph of the scanner}
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "harness/study/scenario/scenario.hpp"

namespace scanbench::results {

struct CatalogueEntry {
  std::string name;
  std::string of;
  std::string shows;
  std::string scenario_as_written;
  std::string scenario;                     ///< its name
  std::vector<study::ModuleChoice> figure;  ///< one, or none: a table
  std::string table;                        ///< the paper's number; "text": values that the paper prints in its text
  std::vector<std::string> pipelines;       ///< empty: all
  std::size_t seeds = 1;
};

/// A figure that cannot be made from simulated scans, and why.
struct AbsentEntry {
  std::string of;
  std::string why;
};

struct Catalogue {
  std::filesystem::path path;
  std::string about;
  std::vector<CatalogueEntry> entries;
  std::vector<AbsentEntry> absent;
  /// The scenarios that the entries need, each once, with the pipelines, seeds and figures that they need.
  std::vector<study::Scenario> scenarios;
};

/// Reads and checks a catalogue and its scenarios; `only`: names of entries, the others are skipped; empty: all. Throws
/// ConfigError with file:line:col for an unknown scenario, figure, pipeline or table, with the known ones, and for an
/// unknown name in `only`.
Catalogue load_catalogue(const std::filesystem::path& path, const std::vector<std::string>& only = {});

/// True if the file has a key `figures` at its top, but none of a scenario or suite. Throws ConfigError for a file that
/// is not YAML.
bool is_catalogue(const std::filesystem::path& path);

/// The same as load_catalogue() from memory; scenarios are found relative to `path`.
Catalogue parse_catalogue(std::string_view text, const std::filesystem::path& path,
                          const std::vector<std::string>& only = {});

}  // namespace scanbench::results
