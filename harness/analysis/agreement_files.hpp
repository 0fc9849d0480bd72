// The comparison with a paper as files for other programs.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "harness/analysis/agreement.hpp"

namespace scanbench::harness {

/// The files of the run folder's `published`: name and bytes (docs/formats.md). `columns` by scenario.
struct NamedBytes {
  std::string name;
  std::string bytes;
};
std::vector<NamedBytes> agreement_files(
    const std::vector<std::pair<std::string, std::vector<ComparedColumn>>>& scenarios);

}  // namespace scanbench::harness
