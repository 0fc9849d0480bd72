// Loads JSON objects and limits their size and depth.
#include "harness/store/json_file.hpp"

#include <cstdint>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "harness/files/atomic_file.hpp"

namespace scanbench::harness {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;

constexpr std::uintmax_t kLargestFile = std::uintmax_t{256} << 20;
constexpr int kDeepest = 32;  // files of a run have four levels; copying a value recurses over its levels

/// Builds a value as Json::parse() does, with a limit of its depth and without one key. A callback of Json::parse()
/// would do the same, but the library then visits all elements of an array again after each object in it: of 10^5 cells
/// that takes seconds.
class Builder : public nlohmann::json_sax<Json> {
 public:
  Builder(const fs::path& file, const std::string& without) : file_(file), without_(without) {}
  Json take() { return std::move(root_); }

  bool null() override { return add(nullptr); }
  bool boolean(bool value) override { return add(value); }
  bool number_integer(number_integer_t value) override { return add(value); }
  bool number_unsigned(number_unsigned_t value) override { return add(value); }
  bool number_float(number_float_t value, const string_t&) override { return add(value); }
  bool string(string_t& value) override { return add(std::move(value)); }
  bool binary(binary_t&) override { return false; }
  bool start_object(std::size_t) override { return open(Json::object()); }
  bool start_array(std::size_t) override { return open(Json::array()); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception&) override { return false; }

  bool key(string_t& name) override {
    if (left_out_ > 0) return true;
    leave_out_next_ = depth_ == 1 && !without_.empty() && name == without_;
    key_ = std::move(name);
    return true;
  }

 private:
  bool add(Json value) {
    if (left_out_ == 0 && !std::exchange(leave_out_next_, false)) place(std::move(value));
    return true;
  }

  bool open(Json empty) {
    if (++depth_ > kDeepest)
      throw ConfigError(file_.string() + ": nested deeper than " + std::to_string(kDeepest) + " levels");
    if (left_out_ > 0 || std::exchange(leave_out_next_, false))
      ++left_out_;
    else
      open_.push_back(place(std::move(empty)));
    return true;
  }

  bool close() {
    --depth_;
    if (left_out_ > 0)
      --left_out_;
    else
      open_.pop_back();
    return true;
  }

  Json* place(Json value) {
    if (open_.empty()) return &(root_ = std::move(value));
    Json& parent = *open_.back();
    if (!parent.is_array()) return &(parent[key_] = std::move(value));
    parent.push_back(std::move(value));
    return &parent.back();
  }

  const fs::path& file_;
  const std::string& without_;
  Json root_;
  std::vector<Json*> open_;  ///< objects and arrays that have not ended; nothing moves them before they end
  std::string key_;
  bool leave_out_next_ = false;
  int left_out_ = 0;  ///< depth within the value that is left out
  int depth_ = 0;
};

Json parse_json(const std::string& bytes, const fs::path& file, const std::string& without) {
  Builder builder(file, without);
  if (!Json::sax_parse(bytes, &builder)) throw ConfigError(file.string() + ": not JSON");
  return builder.take();
}

Json require_object(Json json, const fs::path& file) {
  if (!json.is_object()) throw ConfigError(file.string() + ": not a JSON object");
  return json;
}

}  // namespace

Json load_json(const fs::path& file, const std::string& without) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (fs::exists(status) && !fs::is_regular_file(status)) throw ConfigError(file.string() + ": not a regular file");
  if (const auto size = fs::file_size(file, error); !error && size > kLargestFile)
    throw ConfigError(file.string() + ": has " + std::to_string(size) +
                      " bytes; allowed: " + std::to_string(kLargestFile));
  return parse_json(read_file(file), file, without);
}

Json load_json_object(const fs::path& file, const std::string& without) {
  return require_object(load_json(file, without), file);
}

Json load_json_object(const StoredFiles& files, const RunFile& file) {
  const fs::path path = files.path(file);
  return files.are_archived() ? require_object(parse_json(files.read(file), path, ""), path) : load_json_object(path);
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
