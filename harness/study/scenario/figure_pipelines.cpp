// Compares the pipelines that figures name with those of the scenario.
#include "harness/study/scenario/figure_pipelines.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/names.hpp"
#include "core/registry.hpp"
#include "harness/io/files/text_file.hpp"
#include "harness/io/yaml/reader.hpp"
#include "render/figure.hpp"

namespace scanbench::study {
namespace {

constexpr std::string_view kParam = "pipeline";

/// Error message for the figure's parameter `pipeline`; empty if it is valid.
std::string complaint(const ModuleChoice& figure, const std::vector<PipelineSpec>& pipelines) {
  const auto param = figure.params.find(kParam);
  const auto* wanted = param != figure.params.end() ? std::get_if<std::string>(&param->second) : nullptr;
  if (wanted == nullptr || wanted->empty()) return "";
  std::vector<std::string> names;
  names.reserve(pipelines.size());
  for (const auto& pipeline : pipelines) names.push_back(pipeline.name);
  if (std::ranges::find(names, *wanted) != names.end()) return "";
  return fmt::format("{} of the figure {}: no pipeline is called {}{}", kParam, figure.module,
                     io::quoted_excerpt(*wanted), known_names(*wanted, names));
}

}  // namespace

void check_figure_pipelines(const io::YamlNode& list, const std::vector<ModuleChoice>& figures,
                            const std::vector<PipelineSpec>& pipelines) {
  for (std::size_t i = 0; i < figures.size(); ++i) {
    const std::string wrong = complaint(figures[i], pipelines);
    if (wrong.empty()) continue;
    const io::YamlNode* params = list.items.at(i).find("params");
    const io::YamlNode* node = params != nullptr ? params->find(kParam) : nullptr;
    throw io::PlacedError(node != nullptr ? node->mark : list.items[i].mark, wrong);
  }
}

void check_figure_pipelines(io::Mark mark, const Scenario& scenario) {
  for (const auto& figure : scenario.figures)
    if (const std::string wrong = complaint(figure, scenario.pipelines); !wrong.empty())
      throw io::PlacedError(
          mark, fmt::format("{}: {}; `figures` of the suite replace the scenario's own", scenario.name, wrong));
}

TraceChoice traces_drawn(const Scenario& scenario, std::string_view pipeline) {
  TraceChoice choice;
  for (const auto& figure : scenario.figures)
    for (std::string& name : Registry<render::Figure>::make(figure.module, figure.params)->trace_rows(pipeline))
      choice.names.insert(std::move(name));
  return choice;
}

}  // namespace scanbench::study
