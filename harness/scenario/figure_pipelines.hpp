// Checks that the pipelines which figures name in their parameter `pipeline` exist.
#pragma once

#include <string_view>
#include <vector>

#include "harness/scenario/scenario.hpp"
#include "harness/scenario/trace_choice.hpp"
#include "harness/yaml/gate.hpp"

namespace scanbench::harness {

/// Throws PlacedError for a figure whose `pipeline` (not empty) does not exist, because the figure would be empty. The
/// message names the existing pipelines. `list` is the YAML that the figures were read from.
void check_figure_pipelines(const YamlNode& list, const std::vector<ModuleChoice>& figures,
                            const std::vector<PipelineSpec>& pipelines);

/// The same for figures of a scenario whose pipelines a suite replaces at `mark`.
void check_figure_pipelines(Mark mark, const Scenario& scenario);

/// The rows of a pipeline's trace that the scenario's figures draw from.
TraceChoice traces_drawn(const Scenario& scenario, std::string_view pipeline);

}  // namespace scanbench::harness
