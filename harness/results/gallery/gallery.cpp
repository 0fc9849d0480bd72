// Draws the entries of a catalogue and builds the page that shows them.
#include "harness/results/gallery/gallery.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/index.hpp"
#include "core/names.hpp"
#include "core/params.hpp"
#include "harness/results/analysis/agreement.hpp"
#include "harness/results/document/plain_text.hpp"
#include "harness/results/tables/paper_tables.hpp"
#include "harness/runs/store/summary.hpp"

namespace scanbench::results {
namespace {

namespace fs = std::filesystem;

constexpr const char* kStyle = R"css(<style>
.gallery { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(100%, 24rem), 1fr)); gap: 1.6rem; align-items: start; }
.gallery figure { margin: 0; } .gallery img { width: 100%; max-height: 20rem; object-fit: contain; object-position: left top; }
.gallery h2 { margin: 1.4rem 0 .4rem; padding: 0; border: 0; font-size: 1.05rem; }
.wide { grid-column: 1 / -1; } .gallery code, .command { font-size: .8rem; overflow-wrap: anywhere; }
</style>)css";

const study::Scenario& scenario_of(const Catalogue& catalogue, const CatalogueEntry& entry) {
  return *std::ranges::find(catalogue.scenarios, entry.scenario, &study::Scenario::name);
}

/// The tables of the paper's number, with the times that belong to it.
std::vector<Table> tables_of(const fs::path& run, const study::Scenario& scenario, const std::string& number) {
  const std::string suffix = number == "text" ? "" : number;
  std::vector<Table> tables;
  const std::vector<runs::SummaryRow> rows = runs::load_summary(run / runs::kSummaryFile);
  for (Table& table : paper_tables(scenario.name, compare_with_paper(scenario, rows), rows))
    if (table.id == scenario.name + "-paper-" + suffix || table.id == scenario.name + "-ratios-" + suffix)
      tables.push_back(std::move(table));
  return tables;
}

void make_entry(const fs::path& run, const Catalogue& catalogue, const FigureOptions& options, MadeEntry& made) {
  study::Scenario scenario = scenario_of(catalogue, made.entry);
  if (made.entry.figure.empty()) {
    made.tables = tables_of(run, scenario, made.entry.table);
    if (made.tables.empty()) made.failure = "the run has no values of this table";
    return;
  }
  scenario.figures = made.entry.figure;
  scenario.seeds.resize(std::min(made.entry.seeds, scenario.seeds.size()));
  FigureOptions own = options;
  own.pipelines = made.entry.pipelines;
  own.name = made.entry.name;
  for (FigureFile& file : draw_figures(runs::RunStore(run), scenario, own)) {
    if (file.name.empty())
      made.failure = file.caption;
    else
      made.files.push_back(std::move(file));
  }
  if (made.files.empty() && made.failure.empty())
    made.failure = scenario.figures.front().module + " spans all scenarios of a run: `scanbench figures RUN` draws it";
}

/// "environment {frame: 9}, pipelines iepf, smf, 5 seeds of borges2000.yaml": what makes it.
std::string recipe_of(const CatalogueEntry& entry) {
  std::string text = entry.figure.empty() ? "table " + entry.table : "figure " + entry.figure.front().module;
  if (!entry.pipelines.empty()) text += fmt::format(", pipelines {}", join(entry.pipelines));
  text += fmt::format(", {} seed{}", entry.seeds, entry.seeds == 1 ? "" : "s");
  return text + " of " + entry.scenario_as_written;
}

/// The picture that pages show: PNG if there is one, else SVG; empty if there is neither.
std::string shown_format(const FigureOptions& options) {
  for (const char* format : {"png", "svg"})
    if (std::ranges::count(options.formats, format) > 0) return format;
  return "";
}

Picture picture_of(const MadeEntry& made, const FigureFile& file, const FigureOptions& options) {
  const std::string format = shown_format(options);
  Picture picture{.alt = made.entry.of, .caption = file.caption};
  if (!format.empty()) picture.address = file.name + "." + format;
  for (const std::string& each : options.formats) {
    picture.caption.spans.emplace_back(" ");
    picture.caption.spans.push_back(link(each, file.name + "." + each));
  }
  return picture;
}

/// The paper's number, caption, pictures or tables, and command of an entry.
BlockGroup group_of(const Catalogue& catalogue, const MadeEntry& made, const FigureOptions& options) {
  BlockGroup group{made.tables.empty() ? "entry" : "entry wide",
                   {Heading{2, made.entry.of}, Paragraph{made.entry.shows}},
                   made.entry.name};
  if (!made.failure.empty()) group.blocks.push_back(Paragraph{made.failure, "faint"});
  for (const Table& table : made.tables) group.blocks.push_back(table);
  for (const FigureFile& file : made.files) group.blocks.push_back(picture_of(made, file, options));
  group.blocks.push_back(Paragraph{{code(command_of(catalogue, made.entry)), ": " + recipe_of(made.entry)}, "command"});
  return group;
}

std::string made_sentence(std::size_t entries, std::size_t failed) {
  const std::string all =
      fmt::format("{} figure{} and table{}", entries, entries == 1 ? "" : "s", entries == 1 ? "" : "s");
  if (failed == 0) return all + (entries == 1 ? ", made." : ", all of them made.");
  return fmt::format("{}; {} could not be made.", all, failed);
}

}  // namespace

std::vector<MadeEntry> make_entries(const fs::path& run, const Catalogue& catalogue, const FigureOptions& options,
                                    const std::function<void(double, const std::string&)>& progress) {
  std::vector<MadeEntry> all;
  std::vector<FigureFile> index;
  for (const CatalogueEntry& entry : catalogue.entries) {
    if (progress)
      progress(static_cast<double>(all.size()) / static_cast<double>(catalogue.entries.size()), "draw " + entry.name);
    MadeEntry made{.entry = entry, .files = {}, .tables = {}, .failure = {}};
    make_entry(run, catalogue, options, made);
    index.insert(index.end(), made.files.begin(), made.files.end());
    all.push_back(std::move(made));
  }
  save_figure_index(options.folder, index);
  return all;
}

std::string command_of(const Catalogue& catalogue, const CatalogueEntry& entry) {
  return fmt::format("scanbench figures {} --entry {}", catalogue.path.generic_string(), entry.name);
}

Document gallery_document(const Catalogue& catalogue, const std::vector<MadeEntry>& made, const FigureOptions& options,
                          const std::string& stamp) {
  BlockGroup entries{"gallery", {}};
  for (const MadeEntry& entry : made) entries.blocks.push_back(group_of(catalogue, entry, options));
  const auto failed = std::ranges::count_if(made, [](const MadeEntry& entry) { return !entry.failure.empty(); });
  Document page{.title = "Gallery: " + words_of_name(catalogue.path.stem().string()),
                .blocks = {Markup{kStyle}},
                .lead = made_sentence(made.size(), as_index(failed)),
                .stamp = stamp};
  if (!catalogue.about.empty()) page.blocks.push_back(Paragraph{catalogue.about});
  page.blocks.push_back(std::move(entries));
  if (catalogue.absent.empty()) return page;
  Definitions absent;
  for (const AbsentEntry& entry : catalogue.absent) absent.items.emplace_back(entry.of, entry.why);
  page.blocks.push_back(Heading{2, "Not made", "absent"});
  page.blocks.push_back(std::move(absent));
  return page;
}

}  // namespace scanbench::results
