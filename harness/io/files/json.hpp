// JSON as text. The library's printer and parser are templates of several seconds of compile time: they are used here
// and nowhere else, except where a file is too large for its values to be kept.
#pragma once

#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

namespace scanbench::io {

/// The value on several lines, without a line break at the end. U+FFFD replaces what is no UTF-8.
std::string json_text(const nlohmann::ordered_json& json, int indent = 2);

/// The value on one line, without blanks. U+FFFD replaces what is no UTF-8.
std::string json_line(const nlohmann::ordered_json& json);

/// The same with the keys in alphabetical order, for foreign modules. Throws nlohmann::json::exception for what is no
/// UTF-8.
std::string json_line(const nlohmann::json& json);

/// The value on one line of ASCII: other characters become \uXXXX.
std::string json_ascii_line(const nlohmann::ordered_json& json);

/// The value of a text; one of the type "discarded" if the text is no JSON.
nlohmann::json parsed_json(std::string_view text);

}  // namespace scanbench::io
