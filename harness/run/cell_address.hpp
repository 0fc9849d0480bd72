// The address of a cell: a hash of everything that its bytes depend on.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "harness/scenario/scenario.hpp"
#include "harness/scenario/trace_choice.hpp"

namespace scanbench::harness {

/// SHA-256 of the input of a scenario: its sections in the effective scenario, and the bytes of a log or line file. It
/// is the same for a scenario and for its effective.yaml read back. Throws ConfigError if the file cannot be read.
std::string input_address(const Scenario& scenario);

/// SHA-256 over everything that a cell's bytes depend on: the input, the seed, the pipeline's resolved parameters, the
/// chosen metrics, the rows of the trace that are kept, and the running program.
std::string cell_address(const std::string& input, const std::vector<ModuleChoice>& metrics,
                         const PipelineSpec& pipeline, std::uint64_t seed, const TraceChoice& trace);

}  // namespace scanbench::harness
