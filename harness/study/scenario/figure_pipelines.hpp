// Checks that the pipelines which figures name in their parameter `pipeline` exist.
#pragma once

#include <string_view>
#include <vector>

#include "harness/io/yaml/gate.hpp"
#include "harness/study/scenario/scenario.hpp"
#include "harness/study/scenario/trace_choice.hpp"

namespace scanbench::study {

/// Throws PlacedError for a figure whose `pipeline` (not empty) does not exist, because the figure would be empty. The
/// message names the existing pipelines. `list` is the YAML that the figures were read from.
void check_figure_pipelines(const io::YamlNode& list, const std::vector<ModuleChoice>& figures,
                            const std::vector<PipelineSpec>& pipelines);

/// The same for figures of a scenario whose pipelines a suite replaces at `mark`.
void check_figure_pipelines(io::Mark mark, const Scenario& scenario);

/// The rows of a pipeline's trace that the scenario's figures draw from.
TraceChoice traces_drawn(const Scenario& scenario, std::string_view pipeline);

}  // namespace scanbench::study
