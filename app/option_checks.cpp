// Checks of the values of options.
#include "app/option_checks.hpp"

#include <algorithm>
#include <charconv>
#include <string>
#include <system_error>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/names.hpp"

namespace scanbench::app {

CLI::Validator whole_number(const std::string& what, int low, int high) {
  return {[=](std::string& text) {
            int value = 0;
            const char* end = text.data() + text.size();
            const auto [stop, error] = std::from_chars(text.data(), end, value);
            if (error == std::errc() && stop == end && low <= value && value <= high) return std::string();
            return fmt::format("'{}' is no {}; allowed: a whole number {} .. {}", text, what, low, high);
          },
          fmt::format("{} .. {}", low, high)};
}

CLI::Validator number(const std::string& what, double low, double high) {
  return {[=](std::string& text) {
            double value = 0;
            const char* end = text.data() + text.size();
            const auto [stop, error] = std::from_chars(text.data(), end, value);
            if (error == std::errc() && stop == end && low <= value && value <= high) return std::string();
            return fmt::format("'{}' is no {}; allowed: {} .. {}", text, what, low, high);
          },
          fmt::format("{} .. {}", low, high)};
}

CLI::Validator one_of(const std::string& what, const std::vector<std::string>& words) {
  return {[=](std::string& text) {
            if (std::ranges::find(words, text) != words.end()) return std::string();
            const std::string near = nearest_name(text, words);
            return fmt::format("'{}' is no {}{}; allowed: {}", text, what,
                               near.empty() ? "" : "; did you mean '" + near + "'?", fmt::join(words, ", "));
          },
          fmt::format("{{{}}}", fmt::join(words, ","))};
}

}  // namespace scanbench::app
