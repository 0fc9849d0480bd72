// Reads the JSON files of a run folder, which anybody may have written.
#pragma once

#include <filesystem>

#include <nlohmann/json.hpp>

namespace scanbench::harness {

/// What a file holds. Throws ConfigError, naming the file, if it is no regular file, larger than 256 MiB, no JSON, or
/// nested deeper than 32 levels.
nlohmann::ordered_json load_json(const std::filesystem::path& file);

/// The same; throws for all but an object.
nlohmann::ordered_json load_json_object(const std::filesystem::path& file);

[[noreturn]] void refuse_json(const std::filesystem::path& file, const nlohmann::ordered_json::exception& error);

/// Calls `use` with the object and turns what the library throws for absent keys and values of another type into a
/// ConfigError that names the file.
template <class Use>
auto with_json_of(const std::filesystem::path& file, Use&& use) {
  try {
    return use(load_json_object(file));
  } catch (const nlohmann::ordered_json::exception& error) {
    refuse_json(file, error);
  }
}

}  // namespace scanbench::harness
