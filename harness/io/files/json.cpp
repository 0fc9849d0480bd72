// Prints and parses JSON values.
#include "harness/io/files/json.hpp"

#include <nlohmann/json.hpp>

namespace scanbench::io {
namespace {

constexpr int kOneLine = -1;

std::string printed_json(const nlohmann::ordered_json& json, int indent, bool is_ascii) {
  return json.dump(indent, ' ', is_ascii, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace

std::string json_text(const nlohmann::ordered_json& json, int indent) {
  return printed_json(json, indent, false);
}

std::string json_line(const nlohmann::ordered_json& json) {
  return printed_json(json, kOneLine, false);
}

std::string json_line(const nlohmann::json& json) {
  return json.dump();
}

std::string json_ascii_line(const nlohmann::ordered_json& json) {
  return printed_json(json, kOneLine, true);
}

nlohmann::json parsed_json(std::string_view text) {
  return nlohmann::json::parse(text, nullptr, false);
}

}  // namespace scanbench::io
