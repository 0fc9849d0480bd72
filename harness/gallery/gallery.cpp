// Draws the entries of a catalogue and writes its pages.
#include "harness/gallery/gallery.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/names.hpp"
#include "core/params.hpp"
#include "harness/analysis/agreement.hpp"
#include "harness/page/html_page.hpp"
#include "harness/page/plain_text.hpp"
#include "harness/report/paper_tables.hpp"
#include "harness/store/summary.hpp"

namespace scanbench::harness {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kPageWidth = 120;  // characters of a table

constexpr const char* kStyle = R"css(<style>
.gallery { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(100%, 24rem), 1fr)); gap: 1.6rem; align-items: start; grid-auto-flow: dense; }
.gallery figure { margin: 0; } .gallery img { width: 100%; max-height: 20rem; object-fit: contain; object-position: left top; }
.wide { grid-column: 1 / -1; } .gallery code, .command { font-size: .8rem; overflow-wrap: anywhere; }
</style>)css";

const Scenario& scenario_of(const Catalogue& catalogue, const CatalogueEntry& entry) {
  return *std::ranges::find(catalogue.scenarios, entry.scenario, &Scenario::name);
}

/// The tables of the paper's number, with the times that belong to it.
std::vector<Table> tables_of(const fs::path& run, const Scenario& scenario, const std::string& number) {
  const std::string suffix = number == "text" ? "" : number;
  std::vector<Table> tables;
  for (Table& table : paper_tables(scenario.name, compare_with_paper(scenario, load_summary(run / kSummaryFile))))
    if (table.id == scenario.name + "-paper-" + suffix || table.id == scenario.name + "-ratios-" + suffix)
      tables.push_back(std::move(table));
  return tables;
}

void make_entry(const fs::path& run, const Catalogue& catalogue, const FigureOptions& options, MadeEntry& made) {
  Scenario scenario = scenario_of(catalogue, made.entry);
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
  for (FigureFile& file : draw_figures(RunStore(run), scenario, own)) {
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

std::string html_of(const Catalogue& catalogue, const MadeEntry& made, const FigureOptions& options) {
  const CatalogueEntry& entry = made.entry;
  std::string out =
      fmt::format("<div class=\"entry{}\" id=\"{}\">\n<h3>{}</h3>\n<p>{}</p>\n", made.tables.empty() ? "" : " wide",
                  html_escaped(entry.name), html_escaped(entry.of), html_escaped(entry.shows));
  if (!made.failure.empty()) out += "<p class=\"faint\">" + html_escaped(made.failure) + "</p>\n";
  for (const Table& table : made.tables)
    for (const Table& part : parts_of_width(table, kPageWidth)) out += to_html(part);
  const std::string format = shown_format(options);
  for (const FigureFile& file : made.files) {
    std::string links;
    for (const std::string& each : options.formats)
      links += fmt::format(" <a href=\"{0}.{1}\">{1}</a>", html_escaped(file.name), each);
    if (!format.empty())
      out += fmt::format("<figure><img loading=\"lazy\" alt=\"{0}\" src=\"{1}.{2}\"></figure>\n",
                         html_escaped(file.caption), html_escaped(file.name), format);
    out += fmt::format("<p class=\"caption\">{}{}</p>\n", html_escaped(file.caption), links);
  }
  return out + fmt::format("<p class=\"command\"><code>{}</code><br>{}</p></div>\n",
                           html_escaped(command_of(catalogue, entry)), html_escaped(recipe_of(entry)));
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
  return fmt::format("scanbench figures {} --only {}", catalogue.path.generic_string(), entry.name);
}

std::string gallery_html(const Catalogue& catalogue, const std::vector<MadeEntry>& made, const FigureOptions& options) {
  std::string out = std::string(kStyle) + "<p>" + html_escaped(catalogue.about) + "</p>\n<div class=\"gallery\">\n";
  for (const MadeEntry& entry : made) out += html_of(catalogue, entry, options);
  out += "</div>\n";
  if (!catalogue.absent.empty()) {
    Table table{"absent", "Not made", "", {"of", "why"}, {}, {}};
    for (const AbsentEntry& entry : catalogue.absent) table.rows.push_back({{entry.of, entry.why}, {}, false});
    out += "<div class=\"prose\">" + to_html(table) + "</div>";
  }
  return html_page("Figures of " + catalogue.path.filename().string(), out);
}

std::string gallery_markdown(const Catalogue& catalogue, const std::vector<MadeEntry>& made,
                             const FigureOptions& options, const std::string& pictures) {
  std::string out = "# Gallery\n\n" + markdown_escaped(catalogue.about) + "\n";
  const std::string format = shown_format(options);
  for (const MadeEntry& entry : made) {
    out += fmt::format("\n## {}\n\n{}\n\n", markdown_escaped(entry.entry.of), markdown_escaped(entry.entry.shows));
    if (!entry.failure.empty()) out += markdown_escaped(entry.failure) + "\n\n";
    for (const Table& table : entry.tables) out += to_markdown(table) + "\n";
    for (const FigureFile& file : entry.files)
      out += (format.empty() ? "" : fmt::format("![{}]({}{}.{})\n\n", entry.entry.of, pictures, file.name, format)) +
             markdown_escaped(file.caption) + "\n\n";
    out += fmt::format("`{}`: {}\n", command_of(catalogue, entry.entry), recipe_of(entry.entry));
  }
  if (!catalogue.absent.empty()) out += "\n## Not made\n\n";
  for (const AbsentEntry& entry : catalogue.absent)
    out += fmt::format("- {}: {}\n", markdown_escaped(entry.of), markdown_escaped(entry.why));
  return out;
}

}  // namespace scanbench::harness
