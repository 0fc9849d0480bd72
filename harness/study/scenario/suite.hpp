// Suites: scenarios x levels of factors x pipelines x seeds in one file.
//
//   schema: 1
//   about: four extractors                              # optional
//   scenarios: [../abcdef.yaml, ../four_rooms.yaml]     # relative to the suite
//   seeds: {first: 1, count: 20}                        # optional: replaces the scenarios' own; logs keep theirs
//   pipelines: [...]                                    # optional: replaces the scenarios' own
//   metrics: [...]                                      # optional: replaces the scenarios' own
//   figures: [...]                                      # optional: replaces the scenarios' own
//   published: ../published/paper.csv                   # optional: replaces the scenarios' own
//   plugins: [libmy_lines.so]                          # optional: shared libraries of modules
//   factors: {noise: {1cm: {sensor.sigma_m: 0.01}}}     # optional: every scenario at every combination of levels
//   gates: {f1: 0.005}                                  # optional: what may fail a comparison (gate_spec.hpp)
//   benchmark: {baseline: iepf, example: rooms-1cm}     # optional: one page that ranks the pipelines
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "harness/study/scenario/scenario.hpp"
#include "harness/study/scenario/suite_rules.hpp"

namespace scanbench::study {

struct Suite {
  std::string name;  ///< the file's name without extension
  std::filesystem::path path;
  std::string text;  ///< the file's bytes
  std::string about;
  /// They have the suite's seeds, pipelines and metrics, and different names. With factors, each scenario occurs once
  /// per combination of levels: rooms-ladar-1cm, rooms-ladar-5cm, ...
  std::vector<Scenario> scenarios;
  SuiteRules rules;
};

/// True if the file has a key `scenarios` at its top: suites have it, scenarios do not. Throws ConfigError for a file
/// that is not YAML.
bool is_suite(const std::filesystem::path& path);

/// `sets` are overrides of each scenario, and of the suite's pipelines if it has any. Throws ConfigError with
/// file:line:col.
Suite load_suite(const std::filesystem::path& path, const std::vector<std::string>& sets = {});

/// The same from memory; scenarios are found relative to `path`.
Suite parse_suite(std::string_view text, const std::filesystem::path& path, const std::vector<std::string>& sets = {});

}  // namespace scanbench::study
