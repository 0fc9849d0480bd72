// The address of a cell: a hash of everything that its bytes depend on.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "harness/study/scenario/scenario.hpp"
#include "harness/study/scenario/trace_choice.hpp"

namespace scanbench::runs {

/// SHA-256 of the input of a scenario: its sections in the effective scenario, and the bytes of a log or line file. It
/// is the same for a scenario and for its effective.yaml read back. Throws ConfigError if the file cannot be read.
std::string input_address(const study::Scenario& scenario);

/// SHA-256 of the work of a cell: the pipeline's resolved parameters and the chosen metrics.
std::string work_address(const std::vector<study::ModuleChoice>& metrics, const study::PipelineSpec& pipeline);

/// SHA-256 over everything that a cell's bytes depend on: input_address(), work_address(), the seed, the rows of the
/// trace that are kept, and the running program.
std::string cell_address(const std::string& input, const std::string& work, std::uint64_t seed,
                         const study::TraceChoice& trace);

}  // namespace scanbench::runs
