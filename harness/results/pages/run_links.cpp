// Makes links to the files of a run.
#include "harness/results/pages/run_links.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <regex>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "harness/results/document/html_table.hpp"
#include "harness/runs/store/manifest.hpp"
#include "harness/runs/store/summary.hpp"

namespace scanbench::results {
namespace {

namespace fs = std::filesystem;

struct KnownFile {
  const char* name;
  const char* what;
  bool written_with_pages = false;
};

constexpr KnownFile kFiles[] = {
    {"summary.csv", "the value of every metric in every cell"},
    {"effective.yaml", "every parameter, to run it again"},
    {"effective/", "every parameter of each scenario, to run it again"},
    {"manifest.json", "command, program and machine", true},
    {"artefacts.sha256", "the SHA-256 of every file", true},
    {"report.md", "this page as Markdown", true},
    {kScansPage, "the player: every scan with the lines found in it"},
    {"nightly.html", "the night: what became worse and better"},
    {"published/", "our values beside those of papers, as CSV"},
    {"figures/", "the figures and their captions"},
    {"recordings/", "the scans"},
    {"cells/", "lines, metrics and times of every cell"},
};

/// The folders of the cells: a row per scenario and pipeline, a column per seed.
Table cell_table(const fs::path& run, const std::vector<CellLine>& cells) {
  Table table{"cells", "Folders of cells", "", {"scenario", "pipeline"}, {}, {}};
  std::map<std::uint64_t, std::size_t> columns;
  for (const CellLine& cell : cells) columns.emplace(cell.seed, 0);
  for (auto& [seed, column] : columns) {
    column = table.columns.size();
    table.columns.push_back({"", fmt::format("seed {}", seed)});
  }
  std::map<std::pair<std::string, std::string>, std::size_t> rows;
  for (const CellLine& cell : cells) {
    if (!cell.selected) continue;
    const auto [place, is_new] = rows.try_emplace({cell.scenario, cell.pipeline}, table.rows.size());
    if (is_new) {
      const std::string recording = "recordings/" + cell.scenario + "/";
      table.rows.push_back({{cell.scenario, cell.pipeline},
                            std::vector<TableCell>(columns.size()),
                            false,
                            "",
                            fs::is_directory(run / recording) ? recording : ""});
    }
    TableCell& shown = table.rows[place->second].cells[columns.at(cell.seed)];
    shown.text = cell.status;
    shown.link = cell.folder;
    if (cell.status != "ok") shown.state = cell.status == "missing" ? "missing" : "failed";
  }
  return table;
}

}  // namespace

Prose with_scan_links(const fs::path& run, const std::string& scenario, const std::string& text) {
  static const std::regex number(R"((scan |scan \(|one \()(\d+))");
  if (scenario.empty() || !fs::exists(run / kScansPage)) return {text};
  Prose prose;
  std::size_t at = 0;
  for (auto found = std::sregex_iterator(text.begin(), text.end(), number); found != std::sregex_iterator(); ++found) {
    const auto begin = static_cast<std::size_t>(found->position(2));
    const std::string scan = found->str(2);
    prose.spans.emplace_back(text.substr(at, begin - at));
    prose.spans.push_back(link(scan, fmt::format("{}#{}/{}", kScansPage, scenario, scan), "show it in the player"));
    at = begin + scan.size();
  }
  prose.spans.emplace_back(text.substr(at));
  return prose;
}

Prose figure_caption(const fs::path& run, const FigureFile& figure) {
  Prose caption = with_scan_links(run, figure.scenario, figure.caption);
  if (figure.name.empty()) return caption;
  for (const auto& [ending, name] : {std::pair{"svg", "SVG"}, std::pair{"png", "PNG"}, std::pair{"pdf", "PDF"}}) {
    const std::string file = fmt::format("figures/{}.{}", figure.name, ending);
    if (!fs::exists(run / file)) continue;
    caption.spans.emplace_back(" ");
    caption.spans.push_back(link(name, file));
  }
  return caption;
}

void link_pipelines(Table& table, const std::string& scenario, const std::vector<CellLine>& cells) {
  if (table.row_heads.empty() || table.row_heads.front() != "pipeline") return;
  std::map<std::string, std::set<std::string>> folders;  // by pipeline
  for (const CellLine& cell : cells)
    if (cell.scenario == scenario && !cell.folder.empty()) folders[cell.pipeline].insert(cell.folder);
  for (Table::Row& row : table.rows) {
    const auto own = folders.find(row.heads.front());
    if (own == folders.end()) continue;
    row.link = own->second.size() == 1 ? *own->second.begin() : fmt::format("cells/{}/{}/", scenario, own->first);
  }
}

Blocks file_blocks(const fs::path& run, const std::vector<CellLine>& cells) {
  BulletList files;
  for (const KnownFile& file : kFiles)
    if (file.written_with_pages || fs::exists(run / file.name))
      files.items.push_back({link(file.name, file.name), fmt::format(": {}", file.what)});
  Blocks blocks{std::move(files)};
  if (!fs::exists(run / kScansPage))
    blocks.push_back(
        Paragraph{{"The page that plays the scans is not there; ", code("scanbench report RUN --scans"), " writes it."},
                  "faint"});
  const bool any = std::ranges::any_of(cells, [](const CellLine& cell) { return !cell.folder.empty(); });
  // Markdown has no need of a thousand links.
  if (any)
    blocks.push_back(Markup{"<details class=\"files\"><summary>the folder of every cell and recording</summary>\n" +
                            to_html(cell_table(run, cells)) + "</details>\n"});
  return blocks;
}

}  // namespace scanbench::results
