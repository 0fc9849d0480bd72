// show: one scan of a run and the lines that a pipeline found in it, as a picture.
#include "app/verbs/show.hpp"

#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/picture_options.hpp"
#include "app/seed_list.hpp"
#include "core/error.hpp"
#include "harness/io/files/atomic_file.hpp"
#include "harness/results/figures/shown_scan.hpp"
#include "harness/runs/store/manifest.hpp"
#include "harness/runs/store/run_folder.hpp"
#include "harness/runs/store/run_lock.hpp"

namespace scanbench::app {
namespace {

namespace fs = std::filesystem;

struct ShowOptions {
  std::string run, out, style = "paper";
  std::vector<std::string> seeds;
  results::ScanChoice choice;
  render::OutputStyle look;
  double dpi = 200.0;
};

/// A picture beside the figures of the run is one of its files: the folder is locked, and the manifest lists it.
fs::path keep_in_run(const fs::path& run, const results::ShownScan& shown, double dpi) {
  const runs::RunLock lock(run);
  runs::refuse_linked_folders(run);
  const fs::path path = run / "figures" / (shown.name + ".png");
  io::make_folders(path.parent_path());
  io::write_file_atomically(path, results::picture_bytes(shown.scene, path, dpi));
  runs::refresh_manifest(run);
  return path;
}

int show(const ShowOptions& options) {
  render::OutputStyle look = options.look;
  look.theme = render::theme_from(options.style);
  results::ScanChoice choice = options.choice;
  if (const auto seeds = seeds_of(options.seeds); seeds.size() == 1)
    choice.seed = seeds.front();
  else if (seeds.size() > 1)
    throw ConfigError(fmt::format("--seed: show draws one scan of one seed, and {} are given", seeds.size()));
  results::ShownScan shown = results::show_scan(options.run, choice);
  shown.scene = render::styled(std::move(shown.scene), look);
  fs::path path = options.out;
  if (path.empty())
    path = keep_in_run(options.run, shown, options.dpi);
  else
    io::write_file_atomically(path, results::picture_bytes(shown.scene, path, options.dpi));
  fmt::print("{}\n{}\n", shown.text, path.string());
  return kGood;
}

}  // namespace

void add_show(CommandLine& line) {
  auto options = std::make_shared<ShowOptions>();
  results::ScanChoice& choice = options->choice;
  Verb verb = line.add_verb("show", "Draws one scan of a run with the lines that a pipeline found in it");
  verb.option("RUN", options->run, "a run folder").required();
  verb.option("--pipeline", choice.pipeline, "whose lines (not needed if the run has one pipeline)");
  verb.option("--frame", choice.frame, "number of the scan, from 0, or `worst`: the lowest F1 in scans.csv")
      .shows_default();
  verb.option("--scenario", choice.scenario, "of which scenario (not needed if the run has one)");
  verb.option("--seed", options->seeds, "of which seed (default: the first)").separated_by_commas();
  verb.option("-o,--out", options->out,
              "the picture: a name that ends in .png, .svg or .pdf (default: a .png in RUN/figures)");
  add_picture_options(verb, options->style, options->look, options->dpi);
  verb.runs([options] { return show(*options); });
}

}  // namespace scanbench::app
