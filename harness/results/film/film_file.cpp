// Loads a result, draws the frames one by one, and hands them to the writers of the formats.
#include "harness/results/film/film_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include "core/error.hpp"
#include "core/names.hpp"
#include "core/registry.hpp"
#include "harness/io/files/atomic_file.hpp"
#include "harness/io/files/text_file.hpp"
#include "harness/results/document/plain_text.hpp"
#include "harness/results/figures/recording_note.hpp"
#include "harness/results/film/ffmpeg.hpp"
#include "harness/runs/store/cell_files.hpp"
#include "harness/runs/store/recording_folder.hpp"
#include "harness/runs/store/run_file.hpp"
#include "harness/runs/store/run_folder.hpp"
#include "harness/runs/store/run_scenarios.hpp"
#include "harness/runs/store/run_store.hpp"
#include "harness/runs/store/stored_files.hpp"
#include "harness/runs/store/traces.hpp"
#include "harness/study/scenario/trace_choice.hpp"
#include "render/backends/apng.hpp"
#include "render/backends/gl.hpp"
#include "render/film.hpp"

namespace scanbench::results {
namespace {

namespace fs = std::filesystem;

const runs::RunFile kFilmFiles[] = {runs::RunFile("figures/*.apng"), runs::RunFile("figures/*.mp4")};

const study::Scenario& scenario_of(const std::vector<study::Scenario>& all, const std::string& name,
                                   const fs::path& run) {
  std::vector<std::string> names;
  names.reserve(all.size());
  for (const study::Scenario& scenario : all) names.push_back(scenario.name);
  const auto found = std::ranges::find(all, name, &study::Scenario::name);
  if (found != all.end()) return *found;
  if (name.empty() && all.size() == 1) return all.front();
  if (name.empty())
    throw ConfigError(fmt::format("{} has {} scenarios; --scenario must name one of them: {}", run.string(), all.size(),
                                  join(names)));
  throw ConfigError(
      fmt::format("{} has no scenario {}{}", run.string(), io::quoted_excerpt(name), known_names(name, names)));
}

/// A film with everything that its scenes refer to.
struct LoadedFilm {
  Recording recording;
  PipelineResult result;
  TraceRows trace;
  std::string pipeline;
  std::optional<render::FigureInput> input;
  std::optional<render::Film> film;
};

std::unique_ptr<LoadedFilm> load_film(const runs::RunStore& store, const study::Scenario& scenario,
                                      const std::string& pipeline, const FilmOptions& options) {
  const runs::CellKey key{scenario.name, pipeline, scenario.seeds.front()};
  if (!store.is_ok(key)) return nullptr;
  const runs::StoredFiles cell = store.files(key);
  const auto kind = Registry<render::FilmKind>::make(options.of);
  study::TraceChoice choice;
  for (std::string& row : kind->trace_rows()) choice.names.insert(std::move(row));
  auto loaded = std::make_unique<LoadedFilm>();
  loaded->recording = runs::load_recording(store.recording(key.scenario, key.seed));
  loaded->result = runs::load_result(cell);
  loaded->trace = runs::load_trace(cell, choice);
  loaded->pipeline = pipeline;
  loaded->input.emplace(render::FigureInput{
      .title = words_of_name(scenario.name), .recording = loaded->recording, .waypoints = {}, .results = {}});
  if (const auto* simulated = std::get_if<study::SimulatedInput>(&scenario.input)) {
    const auto continuous = simulated->trajectory.params.find("continuous");
    if (continuous != simulated->trajectory.params.end())
      if (const auto* value = std::get_if<bool>(&continuous->second)) loaded->input->continuous = *value;
  }
  loaded->input->results.push_back({pipeline, &loaded->result, &loaded->trace});
  loaded->film = kind->make(*loaded->input, options.frames);
  return loaded->film ? std::move(loaded) : nullptr;
}

/// Runs the scenario once more, into another folder.
std::string command_with_trace(const fs::path& run, const std::string& scenario) {
  const fs::path alone = run / "effective.yaml";
  const fs::path file = fs::exists(alone) ? alone : run / "effective" / (scenario + ".yaml");
  return fmt::format("scanbench run {} --trace --out {}", shell_word(file.string()),
                     shell_word((run.parent_path() / (scenario + "_trace")).string()));
}

/// The film of the pipeline that the options name, else of the first that has one.
std::unique_ptr<LoadedFilm> find_film(const fs::path& run, const study::Scenario& scenario,
                                      const FilmOptions& options) {
  std::vector<std::string> names;
  for (const study::PipelineSpec& pipeline : scenario.pipelines) names.push_back(pipeline.name);
  if (!options.pipeline.empty() && std::ranges::count(names, options.pipeline) == 0)
    throw ConfigError(fmt::format("{} has no pipeline {}{}", scenario.name, io::quoted_excerpt(options.pipeline),
                                  known_names(options.pipeline, names)));
  const runs::RunStore store(run);
  for (const std::string& name : names)
    if (options.pipeline.empty() || options.pipeline == name)
      if (auto loaded = load_film(store, scenario, name, options)) return loaded;
  const bool from_trace = !Registry<render::FilmKind>::make(options.of)->trace_rows().empty();
  throw ConfigError(fmt::format("{}: there is no film of {} {}: {}", run.string(), options.of,
                                options.pipeline.empty() ? "in " + scenario.name : "of " + options.pipeline,
                                from_trace ? "no finished pipeline has such rows in its trace; `" +
                                                 command_with_trace(run, scenario.name) + "` keeps all of them"
                                           : "the recording has no scans, or no pipeline ended well"));
}

bool has_ending(const fs::path& file) {
  return file.extension() == ".apng" || file.extension() == ".mp4";
}

fs::path without_ending(fs::path file) {
  return has_ending(file) ? file.replace_extension() : file;
}

/// Ten, but of a film of few frames as many as let it last for four seconds.
std::uint16_t frames_per_second(const FilmOptions& options, std::size_t frames) {
  constexpr std::size_t kUsual = 10, kShortestSeconds = 4;
  return options.fps.value_or(
      static_cast<std::uint16_t>(std::clamp<std::size_t>(frames / kShortestSeconds, 1, kUsual)));
}

render::Scene scene_of(const LoadedFilm& loaded, std::size_t frame, const FilmOptions& options) {
  return render::styled(loaded.film->scene(frame), {.theme = options.theme});
}

}  // namespace

FilmFiles make_film(const fs::path& run, const FilmOptions& options,
                    const std::function<void(double, const std::string&)>& progress) {
  const std::vector<study::Scenario> scenarios = runs::load_run_scenarios(run);
  const study::Scenario& scenario = scenario_of(scenarios, options.scenario, run);
  const bool wants_mp4 = std::ranges::count(options.formats, "mp4") > 0;
  const bool wants_apng = std::ranges::count(options.formats, "apng") > 0;
  const fs::path ffmpeg = wants_mp4 ? find_ffmpeg() : fs::path();  // before the work, because it may be missing
  const auto loaded = find_film(run, scenario, options);
  const fs::path base = options.out.empty()
                            ? run / "figures" / fmt::format("{}_{}_{}", scenario.name, loaded->pipeline, options.of)
                            : without_ending(options.out);
  io::make_folders(fs::absolute(base).parent_path());
  const auto with_ending = [&](const char* ending) { return fs::path(base.string() + ending); };

  const std::size_t frames = loaded->film->frames;
  const double dpi = options.width_px / scene_of(*loaded, 0, options).width_in;
  const std::uint16_t fps = frames_per_second(options, frames);
  render::ApngWriter apng(static_cast<std::uint32_t>(frames), fps);
  std::optional<FfmpegPipe> mp4;
  for (std::size_t k = 0; k < frames; ++k) {
    if (progress)
      progress(static_cast<double>(k) / static_cast<double>(frames), fmt::format("frame {} of {}", k + 1, frames));
    const render::Pixels pixels = render::to_pixels(scene_of(*loaded, k, options), dpi);
    if (wants_apng) apng.add(pixels);
    if (wants_mp4 && !mp4) mp4.emplace(ffmpeg, with_ending(".mp4"), pixels.width, pixels.height, fps);
    if (mp4) mp4->add(pixels.rgb);
  }
  FilmFiles made{.files = {},
                 .caption = loaded->film->caption + " " + recording_note(scenario, std::span(scenario.seeds).first(1)),
                 .frames = frames};
  if (wants_apng) {
    io::write_file_atomically(with_ending(".apng"), apng.finish());
    made.files.push_back(with_ending(".apng"));
  }
  if (mp4) {
    mp4->finish();
    made.files.push_back(with_ending(".mp4"));
  }
  return made;
}

}  // namespace scanbench::results
