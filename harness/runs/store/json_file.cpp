// Loads JSON objects and limits their size and depth.
#include "harness/runs/store/json_file.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <system_error>

#include "core/error.hpp"
#include "harness/io/files/atomic_file.hpp"

namespace scanbench::runs {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;

constexpr std::uintmax_t kLargestFile = std::uintmax_t{256} << 20;
constexpr int kDeepest = 32;  // files of a run have four levels; copying a value recurses over its levels

/// The deepest level of a JSON text; of a text that is not JSON, up to its first error. Json::parse() could limit the
/// depth through a callback, but it then visits all elements of an array again after each object in it: of 10^5 cells
/// that takes seconds.
int depth_of(std::string_view text) {
  int depth = 0, deepest = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '"')
      in_string = !in_string;
    else if (in_string)
      i += c == '\\' ? 1 : 0;  // the character after it does not end the string
    else if (c == '{' || c == '[')
      deepest = std::max(deepest, ++depth);
    else if (c == '}' || c == ']')
      --depth;
  }
  return deepest;
}

Json parse_json(const std::string& text, const fs::path& file) {
  if (depth_of(text) > kDeepest)
    throw ConfigError(file.string() + ": nested deeper than " + std::to_string(kDeepest) + " levels");
  Json json = Json::parse(text, nullptr, false);
  if (json.is_discarded()) throw ConfigError(file.string() + ": not JSON");
  return json;
}

Json require_object(Json json, const fs::path& file) {
  if (!json.is_object()) throw ConfigError(file.string() + ": not a JSON object");
  return json;
}

}  // namespace

Json load_json(const fs::path& file) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (fs::exists(status) && !fs::is_regular_file(status)) throw ConfigError(file.string() + ": not a regular file");
  if (const auto size = fs::file_size(file, error); !error && size > kLargestFile)
    throw ConfigError(file.string() + ": has " + std::to_string(size) +
                      " bytes; allowed: " + std::to_string(kLargestFile));
  return parse_json(io::read_file(file), file);
}

Json load_json_object(const fs::path& file) {
  return require_object(load_json(file), file);
}

Json load_json_object(const StoredFiles& files, const RunFile& file) {
  const fs::path path = files.path(file);
  return files.are_archived() ? require_object(parse_json(files.read(file), path), path) : load_json_object(path);
}

void refuse_json(const fs::path& file, const Json::exception& error) {
  constexpr int kNoSuchKey = 403;
  std::string text = error.what();  // "[json.exception.out_of_range.403] key 'suite' not found"
  if (const auto end = text.find("] "); end != std::string::npos) text.erase(0, end + 2);
  if (const auto end = text.find("' not found"); error.id == kNoSuchKey && end != std::string::npos)
    text = "the " + text.substr(0, end) + "' is missing";
  throw ConfigError(file.string() + ": " + text);
}

}  // namespace scanbench::runs
