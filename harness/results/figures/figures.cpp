// Draws the registered figures from the files of a run, and writes them.
#include "harness/results/figures/figures.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/names.hpp"
#include "core/registry.hpp"
#include "harness/io/files/atomic_file.hpp"
#include "harness/io/files/json.hpp"
#include "harness/io/files/text_file.hpp"
#include "harness/results/figures/figure_input/line_difference.hpp"
#include "harness/results/figures/figure_input/measured.hpp"
#include "harness/results/figures/line_verdicts.hpp"
#include "harness/results/figures/recording_note.hpp"
#include "harness/results/figures/why_not_drawn.hpp"
#include "harness/runs/store/cell_files.hpp"
#include "harness/runs/store/cell_status.hpp"
#include "harness/runs/store/json_file.hpp"
#include "harness/runs/store/recording_folder.hpp"
#include "harness/runs/store/run_folder.hpp"
#include "harness/runs/store/traces.hpp"
#include "harness/study/scenario/figure_pipelines.hpp"
#include "harness/study/scenario/simulation_input.hpp"
#include "render/backends/cairo.hpp"
#include "render/backends/gl.hpp"
#include "render/figure.hpp"

namespace scanbench::results {
namespace {

const runs::RunFile kIndexFile("figures/index.json");
const runs::RunFile kFigureFiles[] = {runs::RunFile("figures/*.svg"), runs::RunFile("figures/*.png"),
                                      runs::RunFile("figures/*.pdf"), runs::RunFile("figures/*.caption.txt")};

namespace fs = std::filesystem;

struct LoadedResult {
  std::string pipeline;
  PipelineResult result;
  TraceRows trace;
};

std::vector<LoadedResult> finished_results(const runs::RunStore& store, const study::Scenario& scenario,
                                           std::uint64_t seed) {
  std::vector<LoadedResult> results;
  for (const auto& pipeline : scenario.pipelines) {
    const runs::CellKey key{scenario.name, pipeline.name, seed};
    if (!store.is_ok(key)) continue;
    const runs::StoredFiles cell = store.files(key);
    results.push_back(
        {pipeline.name, runs::load_result(cell), runs::load_trace(cell, study::traces_drawn(scenario, pipeline.name))});
  }
  return results;
}

std::unique_ptr<render::Figure> figure_of(const study::ModuleChoice& choice) {
  return Registry<render::Figure>::make(choice.module, choice.params);
}

/// The scenario with these pipelines only; with all of them if the list is empty.
study::Scenario with_pipelines(study::Scenario scenario, const std::vector<std::string>& names) {
  if (!names.empty())
    std::erase_if(scenario.pipelines,
                  [&](const study::PipelineSpec& p) { return std::ranges::count(names, p.name) == 0; });
  return scenario;
}

ParamSet with_frame(ParamSet params, const std::optional<std::size_t>& frame) {
  if (frame && params.contains("frame")) params["frame"] = static_cast<std::int64_t>(*frame);
  return params;
}

void check_frame(const std::optional<std::size_t>& frame, const Recording& recording, const study::Scenario& scenario) {
  const std::size_t frames = recording.observed.frames.size();
  if (!frame || *frame < frames || std::ranges::none_of(scenario.figures, shows_one_scan)) return;
  if (frames == 0) throw ConfigError("--frame: the recording of " + scenario.name + " has no scans");
  throw ConfigError(fmt::format("--frame: {} has no scan {}; allowed: 0 to {}", scenario.name, *frame, frames - 1));
}

/// A picture that would be wider than PNG files may be is refused before any is drawn.
void check_size(const FigureOptions& options) {
  constexpr double kMostPixels = 20000.0;
  const double pixels = options.style.width_mm / 25.4 * options.dpi;
  if (std::ranges::count(options.formats, "png") > 0 && pixels > kMostPixels)
    throw ConfigError(fmt::format(
        "a picture {} mm wide at {} dpi has {:.0f} pixels; allowed: up to {:.0f}, that is {} "
        "mm at this resolution or {:.0f} dpi at this width",
        options.style.width_mm, options.dpi, pixels, kMostPixels, std::floor(kMostPixels / options.dpi * 25.4),
        std::floor(kMostPixels * 25.4 / options.style.width_mm)));
}

/// Throws ConfigError for a folder that holds anything but figures of this program.
void check_folder(const fs::path& folder) {
  std::error_code error;
  if (!fs::exists(fs::symlink_status(folder, error))) return;
  if (!fs::is_directory(folder, error)) throw ConfigError(folder.string() + ": not a folder");
  const bool is_empty = fs::directory_iterator(folder, error) == fs::directory_iterator();
  if (!is_empty && !fs::exists(folder / kIndexFile, error))
    throw ConfigError(folder.string() +
                      ": not a folder of figures, because it has files but no index.json; name a new or empty folder");
  load_figure_index(folder);
}

}  // namespace

bool shows_one_scan(const study::ModuleChoice& figure) {
  return figure.params.contains("frame");
}

void check_figure_options(const FigureOptions& options, const std::vector<study::Scenario>& scenarios) {
  std::vector<std::string> known;
  bool has_frame = false;
  for (const auto& scenario : scenarios) {
    for (const auto& pipeline : scenario.pipelines)
      if (std::ranges::count(known, pipeline.name) == 0) known.push_back(pipeline.name);
    has_frame = has_frame || std::ranges::any_of(scenario.figures, shows_one_scan);
  }
  for (const std::string& name : options.pipelines)
    if (std::ranges::count(known, name) == 0)
      throw ConfigError("--pipeline: the run has no pipeline " + io::quoted_excerpt(name) + known_names(name, known));
  if (options.frame && !has_frame)
    throw ConfigError("--frame: none of the figures shows a single scan; scan_overlay and environment do");
  check_size(options);
  if (!options.folder.empty()) check_folder(options.folder);
}

std::vector<FigureFile> draw_run_wide_figures(const runs::RunStore& store,
                                              const std::vector<study::Scenario>& scenarios,
                                              const FigureOptions& options) {
  std::vector<study::ModuleChoice> choices;
  for (const study::Scenario& scenario : scenarios)
    for (const study::ModuleChoice& choice : scenario.figures) {
      const auto same = [&](const study::ModuleChoice& c) {
        return c.module == choice.module && c.params == choice.params;
      };
      if (figure_of(choice)->spans_scenarios() && std::ranges::none_of(choices, same)) choices.push_back(choice);
    }
  if (choices.empty()) return {};
  const Recording none{};
  render::FigureInput input{.title = scenarios.size() == 1 ? words_of_name(scenarios.front().name) : "All scenarios",
                            .recording = none,
                            .waypoints = {},
                            .results = {}};
  input.looks = metric_looks();
  for (const study::Scenario& scenario : scenarios)
    input.scenarios.push_back({scenario.name, measured_pipelines(store, with_pipelines(scenario, options.pipelines))});
  if (!input.scenarios.empty()) input.quality = ranked_metric(input.scenarios.front().pipelines);
  std::vector<FigureFile> files;
  for (const study::ModuleChoice& choice : choices) {
    const auto figure = figure_of(choice);
    const auto scenes = figure->draw(input);
    const std::string owner = scenarios.front().name;  // the report shows it there
    if (scenes.empty())
      files.push_back({owner, "", choice.module + " is not drawn: " + why_not_drawn(*figure, input), choice.module});
    for (const auto& drawn : scenes) {
      const auto taken = [&](const std::string& name) {
        return std::ranges::find(files, name, &FigureFile::name) != files.end();
      };
      std::string name = "all_" + drawn.name;
      for (int k = 2; taken(name); ++k) name = fmt::format("all_{}_{}", drawn.name, k);
      write_figure(figure_folder(store.run(), options), name, drawn.scene, drawn.caption, options);
      files.push_back({owner, name, drawn.caption, choice.module});
    }
  }
  return files;
}

void for_each_figure(const runs::RunStore& store, const study::Scenario& all, const FigureOptions& options,
                     const FigureSink& sink, const std::function<void(double, const std::string&)>& progress) {
  const study::Scenario scenario = with_pipelines(all, options.pipelines);
  const std::uint64_t seed = scenario.seeds.front();
  if (scenario.figures.empty()) return;
  const runs::StoredFiles recorded = store.recording(scenario.name, seed);
  if (!recorded.exist()) return;
  const Recording recording = runs::load_recording(recorded);
  check_frame(options.frame, recording, scenario);
  const std::vector<LoadedResult> results = finished_results(store, scenario, seed);
  render::FigureInput input{
      .title = words_of_name(scenario.name), .recording = recording, .waypoints = {}, .results = {}};
  input.measured = measured_pipelines(store, scenario);
  input.quality = ranked_metric(input.measured);
  input.looks = metric_looks();
  if (std::holds_alternative<study::SimulatedInput>(scenario.input)) {
    const sim::SimulationInput simulated = study::simulation_input(scenario, seed);
    input.waypoints = simulated.trajectory.waypoints;
    input.continuous = simulated.trajectory.continuous;
    for (const sim::Circle& circle : simulated.world.circles) input.circles.push_back({circle.center, circle.radius_m});
    for (const sim::MovingBody& body : simulated.world.moving) input.body_paths.push_back(body.path);
  }
  const bool pixels = std::ranges::any_of(
      scenario.figures, [](const study::ModuleChoice& choice) { return figure_of(choice)->compares_pixels(); });
  for (const auto& loaded : results)
    input.results.push_back(
        {loaded.pipeline, &loaded.result, &loaded.trace,
         line_verdicts(recording, loaded.result, segment_rules(scenario.metrics)),
         pixels ? line_difference(recording, loaded.result, raster_rules(scenario.metrics)) : std::nullopt});

  for (std::size_t i = 0; i < scenario.figures.size(); ++i) {
    const auto& choice = scenario.figures[i];
    if (progress) progress(static_cast<double>(i) / static_cast<double>(scenario.figures.size()), choice.module);
    const auto figure = figure_of({choice.kind, choice.module, with_frame(choice.params, options.frame)});
    if (figure->spans_scenarios()) continue;
    const auto shown = std::span(scenario.seeds).first(figure->spans_seeds() ? scenario.seeds.size() : 1);
    const std::string note = recording_note(scenario, shown), title_note = recording_title_note(scenario, shown);
    auto scenes = figure->draw(input);
    if (scenes.empty())
      sink({scenario.name, "", choice.module + " is not drawn: " + why_not_drawn(*figure, input), choice.module}, {});
    for (auto& drawn : scenes) {
      std::string name = options.name.empty() ? scenario.name + "_" + drawn.name : options.name;
      if (!options.name.empty() && scenes.size() > 1) name += "_" + drawn.name;
      if (!drawn.scene.title.empty() && !title_note.empty()) drawn.scene.title += " (" + title_note + ")";
      sink({scenario.name, name, drawn.caption + " " + note, choice.module}, drawn.scene);
    }
  }
}

std::vector<FigureFile> draw_figures(const runs::RunStore& store, const study::Scenario& scenario,
                                     const FigureOptions& options,
                                     const std::function<void(double, const std::string&)>& progress) {
  std::vector<FigureFile> files;
  const fs::path folder = figure_folder(store.run(), options);
  const auto write = [&](const FigureFile& figure, const render::Scene& scene) {
    if (!figure.name.empty()) write_figure(folder, figure.name, scene, figure.caption, options);
    files.push_back(figure);
  };
  for_each_figure(store, scenario, options, write, progress);
  return files;
}

fs::path figure_folder(const fs::path& run, const FigureOptions& options) {
  return options.folder.empty() ? run / "figures" : options.folder;
}

void write_figure(const fs::path& folder, const std::string& name, const render::Scene& scene,
                  const std::string& caption, const FigureOptions& options) {
  io::make_folders(folder);
  const render::Scene drawn = render::styled(scene, options.style);
  for (const std::string& format : options.formats) {
    const std::string bytes = format == "png"   ? render::to_png(drawn, options.dpi)
                              : format == "pdf" ? render::to_pdf(drawn)
                                                : render::to_svg(drawn, caption);
    io::write_file_atomically(folder / (name + "." + format), bytes);
  }
  io::write_file_atomically(folder / (name + ".caption.txt"), caption + "\n");
}

void save_figure_index(const fs::path& folder, const std::vector<FigureFile>& figures) {
  auto list = nlohmann::ordered_json::array();
  for (const auto& figure : figures)
    list.push_back(
        {{"scenario", figure.scenario}, {"name", figure.name}, {"figure", figure.figure}, {"caption", figure.caption}});
  io::make_folders(folder);
  io::write_file_atomically(folder / kIndexFile, io::json_text(list) + "\n");
}

std::vector<FigureFile> load_figure_index(const fs::path& folder) {
  const fs::path path = folder / kIndexFile;
  if (!fs::exists(path)) return {};
  std::vector<FigureFile> figures;
  try {
    for (const auto& entry : runs::load_json(path))
      figures.push_back({entry.at("scenario"), entry.at("name"), entry.at("caption"), entry.value("figure", "")});
  } catch (const nlohmann::ordered_json::exception& error) {
    runs::refuse_json(path, error);
  }
  for (const auto& figure : figures)
    if (!figure.name.empty()) io::check_name("figure", figure.name);  // without one it is a note on what is not drawn
  return figures;
}

}  // namespace scanbench::results
