// Joins words and finds the nearest name by edit distance.
#include "core/names.hpp"

#include <algorithm>

namespace scanbench {
namespace {

// Levenshtein distance: insertions, deletions and substitutions.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substituted = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, substituted});
    }
  }
  return row[b.size()];
}

}  // namespace

std::string join(std::span<const std::string> words, std::string_view separator) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) text += separator;
    text += words[i];
  }
  return text;
}

std::string nearest_name(std::string_view name, const std::vector<std::string>& known) {
  std::string best;
  std::size_t best_distance = std::max<std::size_t>(2, name.size() / 3) + 1;
  for (const auto& candidate : known) {
    const std::size_t d = edit_distance(name, candidate);
    if (d < best_distance) {
      best_distance = d;
      best = candidate;
    }
  }
  return best;
}

std::string known_names(std::string_view name, const std::vector<std::string>& known) {
  if (known.empty()) return "; known: none";
  const std::string near = nearest_name(name, known);
  return (near.empty() ? "; known: " : "; did you mean '" + near + "'? known: ") + join(known);
}

std::string words_of_name(std::string_view name) {
  const auto is_lower = [](char c) { return c >= 'a' && c <= 'z'; };
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  const auto is_year_at = [&](std::size_t i) {
    const std::string_view year = name.substr(i, 4);
    return (year.starts_with("19") || year.starts_with("20")) && year.size() == 4 && is_digit(year[2]) &&
           is_digit(year[3]) && (i + 4 == name.size() || !is_digit(name[i + 4]));
  };
  std::string words;
  for (std::size_t i = 0; i < name.size(); ++i) {
    if (i > 0 && is_lower(name[i - 1]) && is_year_at(i)) words += ' ';
    words += name[i] == '_' ? ' ' : name[i];
  }
  if (!words.empty() && is_lower(words.front())) words.front() = static_cast<char>(words.front() - 'a' + 'A');
  return words;
}

}  // namespace scanbench
