// Reads the JSON files of a run folder, which any program may have written.
#pragma once

#include <filesystem>

#include <nlohmann/json.hpp>

#include "harness/runs/store/run_file.hpp"
#include "harness/runs/store/stored_files.hpp"

namespace scanbench::runs {

/// Loads what a file holds. Throws ConfigError with the file's name unless it is a regular file of at most 256 MiB that
/// contains JSON nested at most 32 levels deep.
nlohmann::ordered_json load_json(const std::filesystem::path& file);

/// Loads an object; throws for any other JSON value too.
nlohmann::ordered_json load_json_object(const std::filesystem::path& file);

/// The same for a file of a cell or recording.
nlohmann::ordered_json load_json_object(const StoredFiles& files, const RunFile& file);

[[noreturn]] void refuse_json(const std::filesystem::path& file, const nlohmann::ordered_json::exception& error);

/// Calls `use` with the object and turns the library's exceptions for missing keys and wrong types into a ConfigError
/// that names the file.
template <class Use>
auto with_json_of(const std::filesystem::path& file, Use&& use) {
  try {
    return use(load_json_object(file));
  } catch (const nlohmann::ordered_json::exception& error) {
    refuse_json(file, error);
  }
}

template <class Use>
auto with_json_of(const StoredFiles& files, const RunFile& file, Use&& use) {
  try {
    return use(load_json_object(files, file));
  } catch (const nlohmann::ordered_json::exception& error) {
    refuse_json(files.path(file), error);
  }
}

}  // namespace scanbench::runs
