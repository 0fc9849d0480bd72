// The verbs simulate, which makes recordings only, and export, which writes recordings as logs and lines as polygons.
#include "app/verbs/recordings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "app/inputs.hpp"
#include "app/options.hpp"
#include "app/seed_list.hpp"
#include "app/terminal/progress.hpp"
#include "harness/io/exchange/export.hpp"
#include "harness/io/exchange/polygon_files.hpp"
#include "harness/io/files/atomic_file.hpp"
#include "harness/runs/execute/make_recording.hpp"
#include "harness/runs/store/cell_files.hpp"
#include "harness/runs/store/manifest.hpp"
#include "harness/runs/store/recording_folder.hpp"
#include "harness/runs/store/run_folder.hpp"
#include "harness/runs/store/run_start.hpp"
#include "harness/runs/store/run_store.hpp"
#include "harness/runs/store/run_target.hpp"
#include "harness/runs/store/stored_files.hpp"
#include "harness/study/scenario/effective.hpp"

namespace scanbench::app {
namespace {

namespace fs = std::filesystem;

struct SimulateOptions {
  std::string file, out;
  std::vector<std::string> sets, seeds;
  int jobs = 1;
  bool quiet = false;
};

/// Throws ConfigError for the folder of a run with cells: `run` and `simulate` share a default folder.
void refuse_to_replace_cells(const fs::path& out) {
  if (!fs::exists(out / runs::kManifestFile)) return;
  const std::size_t cells = runs::load_manifest(out).cells.size();
  if (cells > 0)
    throw ConfigError(
        fmt::format("{} contains a run of {}, which simulate would remove; choose another folder (--out), or "
                    "remove that one",
                    out.string(), counted(cells, "cell")));
}

int simulate(const SimulateOptions& options, const std::vector<std::string>& argv) {
  std::string name;
  auto scenarios = load_inputs({options.file}, options.sets, &name);
  give_seeds(scenarios, options.seeds);
  const fs::path out = (options.out.empty() ? fs::path("out") / name : fs::path(options.out)).lexically_normal();
  refuse_to_replace_cells(out);
  const InterruptGuard guard;
  Progress progress(progress_style(options.quiet));
  runs::RunTarget target(out, false);
  std::vector<std::string> printed;
  std::size_t total = 0;
  for (const auto& scenario : scenarios) total += scenario.seeds.size();
  try {
    runs::Manifest manifest = runs::start_run(target, {scenarios, {}, argv, {}, study::effective_yaml});
    for (const auto& scenario : scenarios)
      for (const auto seed : scenario.seeds) {
        const std::string what = fmt::format("recording {}/{}", scenario.name, seed);
        const auto report = [&](double share) {
          progress.update((static_cast<double>(printed.size()) + share) / static_cast<double>(total), what);
        };
        const Recording recording = runs::make_recording(scenario, seed, options.jobs, report);
        const std::string hash =
            runs::save_recording(runs::recording_path(target.path(), scenario.name, seed), recording);
        printed.push_back(fmt::format("{}  {} scans x {} beams  {}", what, recording.observed.frames.size(),
                                      recording.observed.sensor.geometry.beams(), hash));
      }
    runs::end_run(target, manifest, "complete");
  } catch (...) {
    target.abandon();
    throw;
  }
  progress.finish();
  if (!options.quiet)
    for (const auto& line : printed) fmt::print("{}\n", line);
  return kGood;
}

struct ExportOptions {
  std::string run, out, format = "carmen";
};

constexpr const char* kPolygons = "polygons";

int export_polygons(const ExportOptions& options) {
  const fs::path out = options.out.empty() ? fs::path(options.run) / "export" : fs::path(options.out);
  const runs::RunStore store(options.run);
  for (const auto& key : store.keys()) {
    const runs::StoredFiles cell = store.files(key);
    if (!cell.has(runs::kLinesFile)) continue;
    const std::string text = io::polygons_csv(runs::load_result(cell).lines);
    const fs::path path = out / fmt::format("{}_{}_{}_polygons.csv", key.scenario, key.pipeline, key.seed);
    io::make_folders(out);
    io::write_file_atomically(path, text);
    fmt::print("{}\n", path.string());
  }
  return kGood;
}

int export_recordings(const ExportOptions& options) {
  if (!fs::exists(options.run)) throw ConfigError(options.run + ": no such folder");
  const runs::RunStore store(options.run);
  const auto recordings = store.recordings();
  if (recordings.empty()) throw ConfigError(options.run + ": not a run folder with recordings");
  const std::string ending = options.format == "carmen" ? ".log" : options.format == "csv" ? ".csv" : ".txt";
  const fs::path out = options.out.empty() ? fs::path(options.run) / "export" : fs::path(options.out);
  for (const auto& [scenario, seed] : recordings) {
    const Recording recording = runs::load_recording(store.recording(scenario, seed));
    const fs::path path = out / fmt::format("{}_{}{}", scenario, seed, ending);
    const std::string text = io::export_text(recording, options.format);
    io::make_folders(out);
    io::write_file_atomically(path, text);
    fmt::print("{}\n", path.string());
    if (options.format != "tum")
      for (const auto& [key, value] : io::import_params(recording, options.format))
        fmt::print("  {}: {}\n", key, to_text(value));
  }
  return kGood;
}

}  // namespace

void add_simulate(CommandLine& line) {
  auto options = std::make_shared<SimulateOptions>();
  Verb verb = line.add_verb("simulate", "Makes only the recordings of a scenario");
  verb.option("FILE", options->file, "a scenario or suite file").required();
  verb.option("-o,--out", options->out, "the run folder (default: out/<name of the file>)");
  add_seed_option(verb, options->seeds);
  add_jobs_option(verb, options->jobs, "threads", "number of threads");
  add_set_option(verb, options->sets);
  verb.flag("-q,--quiet", options->quiet, "print only errors");
  verb.runs([&line, options] { return simulate(*options, line.argv()); });
}

void add_export(CommandLine& line) {
  auto options = std::make_shared<ExportOptions>();
  Verb verb =
      line.add_verb("export", "Writes a run's recordings as logs that other programs read, or lines as polygons");
  verb.details("Prints the options with which a scenario reads the logs.");
  verb.option("RUN", options->run, "a run folder").required();
  auto formats = io::export_formats();
  formats.emplace_back(kPolygons);
  verb.option("--format", options->format, "carmen, csv, tum (poses) or polygons (of every cell)")
      .one_of("format", formats)
      .shows_default();
  verb.option("-o,--out", options->out, "the folder to write to (default: RUN/export)");
  verb.runs(
      [options] { return options->format == kPolygons ? export_polygons(*options) : export_recordings(*options); });
}

}  // namespace scanbench::app
