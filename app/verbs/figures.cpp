// figures: draws the figures of a run again, as journals and slides want them, or makes those of a catalogue.
#include "app/verbs/figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/drawing.hpp"
#include "app/inputs.hpp"
#include "app/options.hpp"
#include "app/picture_options.hpp"
#include "app/terminal/progress.hpp"
#include "app/verbs/gallery.hpp"
#include "core/error.hpp"
#include "harness/results/figures/figures.hpp"
#include "harness/results/figures/requested_figures.hpp"
#include "harness/results/gallery/catalogue.hpp"
#include "harness/results/pages/run_report.hpp"
#include "harness/runs/store/run_folder.hpp"
#include "harness/runs/store/run_lock.hpp"
#include "render/output_style.hpp"

namespace scanbench::app {
namespace {

namespace fs = std::filesystem;

struct FiguresVerbOptions {
  std::string run, out, style = "paper";
  std::vector<std::string> files, only;
  int jobs = 1;
  results::FigureOptions figures;
  bool pdf = false, no_title = false, quiet = false;
};

/// The run's own folder always gets SVG and PNG, which its report shows; another folder gets what the user named.
results::FigureOptions figure_options(const FiguresVerbOptions& options) {
  results::FigureOptions figures = options.figures;
  const auto add = [&](const std::string& format) {
    if (std::ranges::count(figures.formats, format) == 0) figures.formats.push_back(format);
  };
  if (options.pdf) add("pdf");
  if (options.out.empty()) add("svg"), add("png");
  figures.style.theme = render::theme_from(options.style);
  figures.style.title = !options.no_title;
  figures.folder = options.out;
  return figures;
}

void print_drawn(const std::vector<results::FigureFile>& drawn, const fs::path& folder, const std::string& format,
                 bool any_figures) {
  for (const auto& figure : drawn) {
    if (figure.name.empty())
      fmt::print("{}: {}\n", figure.scenario, figure.caption);
    else
      fmt::print("{}\n", (folder / (figure.name + "." + format)).string());
  }
  if (drawn.empty())
    fmt::print("nothing to draw: {}\n",
               any_figures ? "the run has no recordings"
                           : "the scenarios name no figures (--with FILE takes those of other scenario files)");
}

/// A catalogue says for each figure which scenario, pipelines and scan it shows.
int gallery(const FiguresVerbOptions& given, const std::vector<std::string>& argv) {
  if (!given.files.empty() || !given.figures.pipelines.empty() || !given.figures.figures.empty() || given.figures.frame)
    throw ConfigError("--with, --figure, --pipeline and --frame are for the figures of a run; " + given.run +
                      " is a catalogue, which names them itself");
  results::FigureOptions figures = figure_options(given);
  const bool is_shown = std::ranges::any_of(figures.formats, [](const auto& format) { return format != "pdf"; });
  if (!is_shown) figures.formats.emplace_back("png");  // a page cannot show PDF
  GalleryOptions options{.catalogue = given.run,
                         .out = given.out,
                         .only = given.only,
                         .jobs = given.jobs,
                         .quiet = given.quiet,
                         .figures = std::move(figures),
                         .argv = argv};
  return make_gallery(std::move(options));
}

int figures(const FiguresVerbOptions& given, const std::vector<std::string>& argv) {
  if (fs::is_regular_file(given.run)) {
    if (!results::is_catalogue(given.run))
      throw ConfigError(given.run + ": a scenario or suite; allowed: a run folder, which `scanbench run " + given.run +
                        "` makes, or a catalogue of figures, like scenarios/figures.yaml");
    return gallery(given, argv);
  }
  if (!given.only.empty())
    throw ConfigError("--entry is for the entries of a catalogue; " + given.run +
                      " is a run folder, of which --figure names the figures");
  const fs::path run = given.run;
  auto scenarios = scenarios_for(run, given.files);
  const std::vector<std::string>& requested = given.figures.figures;
  if (!requested.empty()) scenarios = results::with_figures(std::move(scenarios), requested);
  const results::FigureOptions options = figure_options(given);
  results::check_figure_options(options, scenarios);
  const runs::RunLock lock(run);
  runs::refuse_linked_folders(run);
  const InterruptGuard guard;
  Progress progress(progress_style(given.quiet));
  const std::string failure = draw_within_limits(run, scenarios, options, progress);
  progress.finish();
  if (!failure.empty()) {
    say("scanbench: " + failure + "\n");
    return kCellsFailed;
  }
  if (given.quiet) return kGood;
  const fs::path folder = results::figure_folder(run, options);
  std::vector<results::FigureFile> drawn = results::load_figure_index(folder);
  if (!requested.empty())
    std::erase_if(drawn, [&](const auto& file) { return std::ranges::count(requested, file.figure) == 0; });
  print_drawn(drawn, folder, options.formats.front(),
              std::ranges::any_of(scenarios, [](const auto& s) { return !s.figures.empty(); }));
  return kGood;
}

/// How figures look and which files they become.
void add_style_options(Verb& verb, FiguresVerbOptions& options) {
  results::FigureOptions& figures = options.figures;
  verb.option("--format", figures.formats,
              "pictures to write, separated by commas; RUN/figures always has svg and png, a catalogue svg or png")
      .separated_by_commas()
      .one_of("format", {"svg", "png", "pdf"})
      .shows_default();
  verb.flag("--pdf", options.pdf, "also as PDF: short for --format svg,png,pdf");
  add_picture_options(verb, options.style, figures.style, figures.dpi);
  verb.option("--font-pt", figures.style.font_pt, "size of the letters (default: 8 pt, 14 pt on slides)")
      .number("font size in pt", render::kLeastFontPt, render::kMostFontPt);
  verb.flag("--no-title", options.no_title, "without the title over the panels");
}

}  // namespace

void add_figures(CommandLine& line) {
  auto options = std::make_shared<FiguresVerbOptions>();
  Verb verb =
      line.add_verb("figures", "Draws the figures of a run again, from its files, or makes all figures of a catalogue");
  verb.option("RUN", options->run, "a run folder, or a catalogue of figures (scenarios/figures.yaml)").required();
  verb.option("--with", options->files, "scenario files whose figures replace the run's own");
  verb.option(
      "-o,--out", options->out,
      "an own folder for the figures (default: RUN/figures, which the report shows; of a catalogue out/<its name>)");
  add_style_options(verb, *options);
  verb.option(
          "--figure", options->figures.figures,
          "only these figures, separated by commas, whether or not the scenarios list them (scanbench list figures); "
          "the folder keeps its others")
      .separated_by_commas();
  verb.option("--pipeline", options->figures.pipelines, "only these pipelines, separated by commas")
      .separated_by_commas();
  verb.option("--frame", options->figures.frame, "number of the scan, from 0, that figures of one scan show");
  verb.option("--entry", options->only, "of a catalogue: only these entries, separated by commas")
      .separated_by_commas();
  verb.renamed("--pipelines", "`figures --pipelines` is now `figures --pipeline`");
  verb.renamed("--only", "`figures --only` is now `figures --entry`; --figure names the figures of a run");
  add_jobs_option(verb, options->jobs, "of a catalogue: number of cells that run at the same time");
  verb.flag("-q,--quiet", options->quiet, "print only errors");
  verb.runs([&line, options] { return figures(*options, line.argv()); });
}

}  // namespace scanbench::app
