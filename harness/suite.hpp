// Suites: scenarios x pipelines x seeds in one file, for a nightly run.
//
//   schema: 1
//   about: what is compared                             # optional
//   scenarios: [../abcdef.yaml, ../four_rooms.yaml]     # relative to the suite
//   seeds: {first: 1, count: 20}                        # optional: in place of the scenarios' own (not of logs)
//   pipelines: [...]                                    # optional: in place of the scenarios' own
//   metrics: [...]                                      # optional: in place of the scenarios' own
//   figures: [...]                                      # optional: in place of the scenarios' own
//   published: ../published/paper.csv                   # optional: in place of the scenarios' own
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "harness/scenario.hpp"

namespace scanbench::harness {

struct Suite {
  std::string name;  ///< the file's name without ending
  std::filesystem::path path;
  std::string text;  ///< the file's bytes
  std::string about;
  std::vector<Scenario> scenarios;  ///< with the suite's seeds, pipelines and metrics in them; different names
};

/// True if the file has a key `scenarios` at its top, which is what tells a suite from a scenario. Throws ConfigError
/// for a file that is not YAML.
bool is_suite(const std::filesystem::path& path);

/// `sets` are overrides of each scenario (not of the suite). Throws ConfigError with file:line:col.
Suite load_suite(const std::filesystem::path& path, const std::vector<std::string>& sets = {});

/// The same from memory; scenarios are found relative to `path`.
Suite parse_suite(std::string_view text, const std::filesystem::path& path, const std::vector<std::string>& sets = {});

}  // namespace scanbench::harness
