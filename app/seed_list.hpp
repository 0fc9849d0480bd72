// --seed: seeds and ranges of seeds.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "app/options.hpp"

namespace scanbench::app {

/// --seed, whose texts seeds_of() reads.
void add_seed_option(Verb& verb, std::vector<std::string>& texts);

/// The seeds of texts like "1", "5-7": from the first to the last, in the order given. Throws ConfigError for what is
/// not a seed, a range that is reversed, a seed that occurs twice, and more seeds than a scenario may have.
std::vector<std::uint64_t> seeds_of(const std::vector<std::string>& texts);

}  // namespace scanbench::app
