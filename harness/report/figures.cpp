// Draws the registered figures from the files of a run, and writes them.
#include "harness/report/figures.hpp"

#include <algorithm>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/registry.hpp"
#include "harness/files/atomic_file.hpp"
#include "harness/report/figure_input/line_difference.hpp"
#include "harness/report/figure_input/measured.hpp"
#include "harness/report/line_verdicts.hpp"
#include "harness/scenario/figure_pipelines.hpp"
#include "harness/scenario/simulation_input.hpp"
#include "harness/store/cell_files.hpp"
#include "harness/store/cell_status.hpp"
#include "harness/store/json_file.hpp"
#include "harness/store/recording_folder.hpp"
#include "harness/store/run_folder.hpp"
#include "harness/store/traces.hpp"
#include "render/backends/cairo.hpp"
#include "render/backends/gl.hpp"
#include "render/figure.hpp"

namespace scanbench::harness {
namespace {

const RunFile kIndexFile("figures/index.json");
const RunFile kFigureFiles[] = {RunFile("figures/*.svg"), RunFile("figures/*.png"), RunFile("figures/*.pdf")};

namespace fs = std::filesystem;

struct LoadedResult {
  std::string pipeline;
  PipelineResult result;
  TraceRows trace;
};

std::vector<LoadedResult> finished_results(const fs::path& run, const Scenario& scenario, std::uint64_t seed) {
  std::vector<LoadedResult> results;
  for (const auto& pipeline : scenario.pipelines) {
    const fs::path cell = cell_path(run, {scenario.name, pipeline.name, seed});
    if (!fs::exists(cell / kStatusFile) || load_status(cell).outcome.status != CellStatus::ok) continue;
    results.push_back({pipeline.name, load_result(cell), load_trace(cell, traces_drawn(scenario, pipeline.name))});
  }
  return results;
}

std::unique_ptr<render::Figure> figure_of(const ModuleChoice& choice) {
  return Registry<render::Figure>::make(choice.module, choice.params);
}

}  // namespace

std::vector<FigureFile> draw_run_wide_figures(const fs::path& run, const std::vector<Scenario>& scenarios, bool pdf) {
  std::vector<ModuleChoice> choices;
  for (const Scenario& scenario : scenarios)
    for (const ModuleChoice& choice : scenario.figures) {
      const auto same = [&](const ModuleChoice& c) { return c.module == choice.module && c.params == choice.params; };
      if (figure_of(choice)->spans_scenarios() && std::ranges::none_of(choices, same)) choices.push_back(choice);
    }
  if (choices.empty()) return {};
  const Recording none{};
  render::FigureInput input{.title = scenarios.size() == 1 ? scenarios.front().name : "all scenarios",
                            .recording = none,
                            .waypoints = {},
                            .results = {}};
  input.looks = metric_looks();
  for (const Scenario& scenario : scenarios)
    input.scenarios.push_back({scenario.name, measured_pipelines(run, scenario)});
  std::vector<FigureFile> files;
  for (const ModuleChoice& choice : choices) {
    const auto figure = figure_of(choice);
    const auto scenes = figure->draw(input);
    const std::string owner = scenarios.front().name;  // the report shows it there
    if (scenes.empty()) files.push_back({owner, "", choice.module + " is not drawn: " + figure->why_nothing(input)});
    for (const auto& drawn : scenes) {
      const auto taken = [&](const std::string& name) {
        return std::ranges::find(files, name, &FigureFile::name) != files.end();
      };
      std::string name = "all_" + drawn.name;
      for (int k = 2; taken(name); ++k) name = fmt::format("all_{}_{}", drawn.name, k);
      write_figure(run, name, drawn.scene, pdf);
      files.push_back({owner, name, drawn.caption});
    }
  }
  return files;
}

std::vector<FigureFile> draw_figures(const fs::path& run, const Scenario& scenario, bool pdf,
                                     const std::function<void(double, const std::string&)>& progress) {
  const std::uint64_t seed = scenario.seeds.front();
  const fs::path folder = recording_path(run, scenario.name, seed);
  if (scenario.figures.empty() || !fs::exists(folder)) return {};
  const Recording recording = load_recording(folder);
  const std::vector<LoadedResult> results = finished_results(run, scenario, seed);
  render::FigureInput input{.title = scenario.name, .recording = recording, .waypoints = {}, .results = {}};
  input.measured = measured_pipelines(run, scenario);
  input.looks = metric_looks();
  if (std::holds_alternative<SimulatedInput>(scenario.input)) {
    const sim::SimulationInput simulated = simulation_input(scenario, seed);
    input.waypoints = simulated.trajectory.waypoints;
    input.continuous = simulated.trajectory.continuous;
    for (const sim::Circle& circle : simulated.world.circles) input.circles.push_back({circle.center, circle.radius_m});
    for (const sim::MovingBody& body : simulated.world.moving) input.body_paths.push_back(body.path);
  }
  const bool pixels = std::ranges::any_of(
      scenario.figures, [](const ModuleChoice& choice) { return figure_of(choice)->compares_pixels(); });
  for (const auto& loaded : results)
    input.results.push_back(
        {loaded.pipeline, &loaded.result, &loaded.trace,
         line_verdicts(recording, loaded.result, segment_rules(scenario.metrics)),
         pixels ? line_difference(recording, loaded.result, raster_rules(scenario.metrics)) : std::nullopt});

  std::vector<FigureFile> files;
  for (std::size_t i = 0; i < scenario.figures.size(); ++i) {
    const auto& choice = scenario.figures[i];
    if (progress) progress(static_cast<double>(i) / static_cast<double>(scenario.figures.size()), choice.module);
    const auto figure = figure_of(choice);
    if (figure->spans_scenarios()) continue;
    const auto scenes = figure->draw(input);
    if (scenes.empty())
      files.push_back({scenario.name, "", choice.module + " is not drawn: " + figure->why_nothing(input)});
    for (const auto& drawn : scenes) {
      const std::string name = scenario.name + "_" + drawn.name;
      write_figure(run, name, drawn.scene, pdf);
      files.push_back({scenario.name, name, drawn.caption});
    }
  }
  return files;
}

void write_figure(const fs::path& run, const std::string& name, const render::Scene& scene, bool pdf) {
  make_folders(run / "figures");
  write_file_atomically(run / "figures" / (name + ".svg"), render::to_svg(scene));
  write_file_atomically(run / "figures" / (name + ".png"), render::to_png(scene));
  if (pdf) write_file_atomically(run / "figures" / (name + ".pdf"), render::to_pdf(scene));
}

void save_figure_index(const fs::path& run, const std::vector<FigureFile>& figures) {
  auto list = nlohmann::ordered_json::array();
  for (const auto& figure : figures)
    list.push_back({{"scenario", figure.scenario}, {"name", figure.name}, {"caption", figure.caption}});
  make_folders(run / "figures");
  write_file_atomically(run / "figures" / kIndexFile, list.dump(2) + "\n");
}

std::vector<FigureFile> load_figure_index(const fs::path& run) {
  const fs::path path = run / "figures" / kIndexFile;
  if (!fs::exists(path)) return {};
  std::vector<FigureFile> figures;
  try {
    for (const auto& entry : load_json(path))
      figures.push_back({entry.at("scenario"), entry.at("name"), entry.at("caption")});
  } catch (const nlohmann::ordered_json::exception& error) {
    refuse_json(path, error);
  }
  for (const auto& figure : figures)
    if (!figure.name.empty()) check_name("figure", figure.name);  // without one it is a note on what is not drawn
  return figures;
}

}  // namespace scanbench::harness
