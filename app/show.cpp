// show: one scan of a run and the lines that a pipeline found in it, as a picture.
#include "app/show.hpp"

#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "harness/files/atomic_file.hpp"
#include "harness/report/shown_scan.hpp"
#include "harness/store/manifest.hpp"
#include "harness/store/run_folder.hpp"
#include "harness/store/run_lock.hpp"

namespace scanbench::app {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::string run, out;
  harness::ScanChoice choice;
};

/// A picture beside the figures of the run is one of its files: the folder is locked, and the manifest lists it.
fs::path keep_in_run(const fs::path& run, const harness::ShownScan& shown) {
  const harness::RunLock lock(run);
  harness::refuse_linked_folders(run);
  const fs::path path = run / "figures" / (shown.name + ".png");
  harness::make_folders(path.parent_path());
  harness::write_file_atomically(path, harness::picture_bytes(shown.scene, path));
  harness::refresh_manifest(run);
  return path;
}

int show(const Options& options) {
  const harness::ShownScan shown = harness::show_scan(options.run, options.choice);
  fs::path path = options.out;
  if (path.empty())
    path = keep_in_run(options.run, shown);
  else
    harness::write_file_atomically(path, harness::picture_bytes(shown.scene, path));
  fmt::print("{}\n{}\n", shown.text, path.string());
  return kGood;
}

}  // namespace

void add_show(Context& context) {
  auto options = std::make_shared<Options>();
  harness::ScanChoice& choice = options->choice;
  auto* verb = context.app.add_subcommand("show", "Draws one scan of a run with the lines that a pipeline found in it");
  verb->add_option("RUN", options->run, "a run folder")->required();
  verb->add_option("--pipeline", choice.pipeline, "whose lines (not needed if the run has one pipeline)");
  verb->add_option("--frame", choice.frame, "number of the scan, from 0, or `worst`: the lowest F1 in scans.csv")
      ->capture_default_str();
  verb->add_option("--scenario", choice.scenario, "of which scenario (not needed if the run has one)");
  verb->add_option("--seed", choice.seed, "of which seed (default: the first)");
  verb->add_option("-o,--out", options->out,
                   "the picture: a name that ends in .png, .svg or .pdf (default: a .png in RUN/figures)");
  verb->callback([&context, options] { context.action = [options] { return show(*options); }; });
}

}  // namespace scanbench::app
