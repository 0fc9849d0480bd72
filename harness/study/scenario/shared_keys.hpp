// Readers of the keys that scenarios, suites and worlds share.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "harness/io/yaml/reader.hpp"
#include "harness/study/catalog/pipeline_spec.hpp"
#include "harness/study/scenario/foreign_slot.hpp"

namespace scanbench::study {

/// Of one scenario.
inline constexpr std::size_t kMostSeeds = 100000;

/// Checks the key `schema`: present, and 1. Throws PlacedError.
void read_schema(io::YamlMap& map);

/// The value of `seed` or `seeds`; empty if the map has neither. Throws PlacedError.
std::vector<std::uint64_t> read_seeds(io::YamlMap& map);

/// A list of at least one pipeline, each a valid chain (chain.hpp). Throws PlacedError.
std::vector<PipelineSpec> read_pipelines(const io::YamlNode& node, bool scans, const ModuleSources& sources);

/// A list of names or {name, params}; kind is `metrics` or `figure`. Throws PlacedError.
std::vector<ModuleChoice> read_choices(const io::YamlNode& node, const std::string& kind);

/// Throws PlacedError unless `name` can name a folder: letters, digits, _ - . and no leading dot. `what` is for the
/// message.
void require_folder_name(const std::string& name, io::Mark mark, const std::string& what);

/// A path with ${SCANBENCH_DATA} replaced, relative to the folder of `file`, or to the working directory if it came
/// from a `--set`. Throws PlacedError if the variable is not set or the file does not exist; with `may_be_absent` the
/// variable may then remain in the path.
std::filesystem::path resolve_path(const io::YamlNode& node, const std::string& text, const std::filesystem::path& file,
                                   bool may_be_absent = false);

/// Runs `work`. Its ParamErrors get the place of the parameter in `map`, its other ConfigErrors the place of the map.
template <class Work>
auto at_param(const io::YamlNode& map, Work&& work) {
  try {
    return work();
  } catch (const io::PlacedError&) {
    throw;
  } catch (const ParamError& error) {
    for (const auto& entry : map.entries)
      if (entry.key == error.param()) throw io::PlacedError(entry.value.mark, error.what());
    throw io::PlacedError(map.mark, error.what());
  } catch (const ConfigError& error) {
    throw io::PlacedError(map.mark, error.what());
  }
}

}  // namespace scanbench::study
