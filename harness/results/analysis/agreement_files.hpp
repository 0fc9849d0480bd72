// The comparison with a paper as files for other programs.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "harness/results/analysis/agreement.hpp"

namespace scanbench::results {

/// A file of a run's folder `published` (docs/formats.md). agreement_files() makes them from the columns of each
/// scenario.
struct NamedBytes {
  std::string name;
  std::string bytes;
};
std::vector<NamedBytes> agreement_files(
    const std::vector<std::pair<std::string, std::vector<ComparedColumn>>>& scenarios);

}  // namespace scanbench::results
