// A figure may show one pipeline: its parameter `pipeline` names it, and the scenario must have it.
#pragma once

#include <vector>

#include "harness/scenario.hpp"
#include "harness/yaml_gate.hpp"

namespace scanbench::harness {

/// Refuses a figure whose `pipeline` (not empty) is none of these: nothing would be drawn. `list` is the YAML that the
/// figures were read from. Throws PlacedError at that parameter, naming the pipelines that there are.
void check_figure_pipelines(const YamlNode& list, const std::vector<ModuleChoice>& figures,
                            const std::vector<PipelineSpec>& pipelines);

/// The same for figures of a scenario whose pipelines a suite replaces at `mark`.
void check_figure_pipelines(YamlMark mark, const Scenario& scenario);

}  // namespace scanbench::harness
