// Names in messages: lists of them, and the one that a misspelt name probably means.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace scanbench {

/// "a, b, c"; empty for no words.
std::string join(std::span<const std::string> words, std::string_view separator = ", ");

/// The known name with the smallest edit distance to a misspelt one: at most 2 edits, or a third of the name's length
/// if that is more. Of equally near names the first; empty if none is near.
std::string nearest_name(std::string_view name, const std::vector<std::string>& known);

/// The end of a message about an unknown name: "; did you mean 'b'? known: a, b", "; known: a, b" where no name is
/// near, and "; known: none".
std::string known_names(std::string_view name, const std::vector<std::string>& known);

/// The words of a name, for titles: "Lakaemper 2009 hallway" of lakaemper2009_hallway.
std::string words_of_name(std::string_view name);

}  // namespace scanbench
