// Runs the scenarios of a catalogue, reusing the cells of an earlier run, and draws its entries.
#include "app/verbs/gallery.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

#include "app/exit_code.hpp"
#include "app/terminal/progress.hpp"
#include "app/terminal/running.hpp"
#include "harness/io/files/atomic_file.hpp"
#include "harness/results/document/document.hpp"
#include "harness/results/document/html_page.hpp"
#include "harness/results/gallery/catalogue.hpp"
#include "harness/results/gallery/gallery.hpp"
#include "harness/runs/execute/run_options.hpp"
#include "harness/runs/store/manifest.hpp"

namespace scanbench::app {
namespace {

namespace fs = std::filesystem;

runs::RunOptions run_options(const GalleryOptions& options) {
  runs::RunOptions run;
  run.out = options.out / "run";
  run.jobs = options.jobs;
  run.resume = fs::exists(run.out / runs::kManifestFile);
  run.argv = options.argv;
  return run;
}

}  // namespace

int make_gallery(GalleryOptions options) {
  if (options.out.empty()) options.out = fs::path("out") / options.catalogue.stem();
  options.figures.folder = options.out;
  const results::Catalogue catalogue = results::load_catalogue(options.catalogue, options.only);
  results::check_figure_options(options.figures, catalogue.scenarios);
  if (!fs::exists(options.out)) results::save_figure_index(options.out, {});  // marks the folder as one of figures
  const FinishedRun finished = run_and_report(catalogue.scenarios, run_options(options), {options.quiet, false});
  say(unfinished_text(finished.result));
  if (finished.result.interrupted) return kInterrupted;

  const InterruptGuard guard;
  Progress progress(progress_style(options.quiet));
  const auto made = results::make_entries(finished.result.out, catalogue, options.figures,
                                          [&](double share, const std::string& what) { progress.update(share, what); });
  progress.finish();
  auto facts = runs::manifest_facts(finished.result.out);
  std::erase_if(facts, [](const auto& fact) { return fact.first == "started"; });  // the same figures, the same page
  const results::Document page =
      results::gallery_document(catalogue, made, options.figures, results::stamp_of(facts, {}));
  io::write_file_atomically(options.out / "gallery.md", results::to_markdown(page));
  io::write_file_atomically(options.out / "index.html", results::to_html(page));
  for (const auto& entry : made)
    if (!entry.failure.empty()) say(fmt::format("{}: not made: {}\n", entry.entry.name, entry.failure));
  if (!options.quiet) fmt::print("{}\n", (options.out / "index.html").string());
  const bool all = std::ranges::all_of(made, [](const auto& entry) { return entry.failure.empty(); });
  return finished.result.exit_code() == kGood && !all ? kCellsFailed : finished.result.exit_code();
}

}  // namespace scanbench::app
