// Reads seeds and ranges of seeds.
#include "app/seed_list.hpp"

#include <fmt/format.h>

#include <charconv>
#include <optional>
#include <set>
#include <string_view>
#include <system_error>

#include "core/error.hpp"
#include "harness/study/scenario/scenario.hpp"
#include "harness/study/scenario/shared_keys.hpp"

namespace scanbench::app {
namespace {

std::optional<std::uint64_t> seed_from(std::string_view text) {
  std::uint64_t seed = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, seed);
  if (text.empty() || error != std::errc() || stop != end || seed > study::kLargestSeed) return std::nullopt;
  return seed;
}

struct SeedRange {
  std::uint64_t first = 0, last = 0;
};

SeedRange range_from(const std::string& text) {
  const auto dash = text.find('-');
  const auto first = seed_from(std::string_view(text).substr(0, dash));
  const auto last = dash == std::string::npos ? first : seed_from(std::string_view(text).substr(dash + 1));
  if (!first || !last)
    throw ConfigError(
        fmt::format("--seed: '{}' is not a seed; allowed: whole numbers 0 .. {} and ranges of them, "
                    "separated by commas: 1,3,5-7",
                    text, study::kLargestSeed));
  if (*last < *first) throw ConfigError(fmt::format("--seed: {} is reversed; allowed: {}-{}", text, *last, *first));
  return {*first, *last};
}

}  // namespace

void add_seed_option(Verb& verb, std::vector<std::string>& texts) {
  verb.option("--seed", texts, "seeds that replace the file's: 7, 1,3,5-7 or 1-20").separated_by_commas();
}

std::vector<std::uint64_t> seeds_of(const std::vector<std::string>& texts) {
  std::vector<std::uint64_t> seeds;
  std::set<std::uint64_t> seen;
  for (const auto& text : texts) {
    const auto [first, last] = range_from(text);
    if (last - first >= study::kMostSeeds - seeds.size())
      throw ConfigError(fmt::format("--seed: with {} there are {} seeds; allowed: up to {}", text,
                                    seeds.size() + (last - first) + 1, study::kMostSeeds));
    for (std::uint64_t seed = first; seed <= last; ++seed) {
      if (!seen.insert(seed).second) throw ConfigError(fmt::format("--seed: {} is given twice", seed));
      seeds.push_back(seed);
    }
  }
  return seeds;
}

}  // namespace scanbench::app
