// Loads JSON objects and limits their size and depth.
#include "harness/store/json_file.hpp"

#include <cstdint>
#include <string>
#include <system_error>

#include "core/error.hpp"
#include "harness/files/atomic_file.hpp"

namespace scanbench::harness {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;

constexpr std::uintmax_t kLargestFile = std::uintmax_t{256} << 20;
constexpr int kDeepest = 32;  // files of a run have four levels; copying a value recurses over its levels

}  // namespace

Json load_json(const fs::path& file, const std::string& without) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (fs::exists(status) && !fs::is_regular_file(status)) throw ConfigError(file.string() + ": not a regular file");
  if (const auto size = fs::file_size(file, error); !error && size > kLargestFile)
    throw ConfigError(file.string() + ": has " + std::to_string(size) +
                      " bytes; allowed: " + std::to_string(kLargestFile));
  const auto keep = [&](int depth, Json::parse_event_t event, const Json& value) {
    if (depth > kDeepest)
      throw ConfigError(file.string() + ": nested deeper than " + std::to_string(kDeepest) + " levels");
    return event != Json::parse_event_t::key || depth != 1 || without.empty() || value != without;
  };
  Json json = Json::parse(read_file(file), keep, false);
  if (json.is_discarded()) throw ConfigError(file.string() + ": not JSON");
  return json;
}

Json load_json_object(const fs::path& file, const std::string& without) {
  Json json = load_json(file, without);
  if (!json.is_object()) throw ConfigError(file.string() + ": not a JSON object");
  return json;
}

void refuse_json(const fs::path& file, const Json::exception& error) {
  constexpr int kNoSuchKey = 403;
  std::string text = error.what();  // "[json.exception.out_of_range.403] key 'suite' not found"
  if (const auto end = text.find("] "); end != std::string::npos) text.erase(0, end + 2);
  if (const auto end = text.find("' not found"); error.id == kNoSuchKey && end != std::string::npos)
    text = "the " + text.substr(0, end) + "' is missing";
  throw ConfigError(file.string() + ": " + text);
}

}  // namespace scanbench::harness
