// Writes the frame of report pages and the parts that they share.
#include "harness/report/html_page.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "harness/files/atomic_file.hpp"
#include "harness/files/base64.hpp"
#include "harness/report/plain_text.hpp"
#include "harness/report/table.hpp"

namespace scanbench::harness {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kLargestSvg = std::uintmax_t{8} << 20;  // a larger one is shown as PNG, which is smaller

constexpr std::string_view kStyle = R"css(
:root { --ink: #1b1f24; --faint: #667079; --rule: #d5dade; --paper: #fff; --tint: #f4f6f8; --accent: #0072b2; }
@media (prefers-color-scheme: dark) {
  :root { --ink: #e6e9ec; --faint: #98a3ac; --rule: #3a4249; --paper: #15181b; --tint: #1f2428; --accent: #56b4e9; }
  figure img { background: #fff; }
}
* { box-sizing: border-box; }
body { margin: 0 auto; max-width: 78rem; padding: 1.5rem; background: var(--paper); color: var(--ink);
       font: 15px/1.5 system-ui, "DejaVu Sans", sans-serif; }
h1 { font-size: 1.7rem; margin: 0 0 .2rem; } h2 { margin: 2.2rem 0 .4rem; font-size: 1.3rem; border-top: 2px solid var(--ink); padding-top: .6rem; }
h3 { margin: 1.4rem 0 .4rem; font-size: 1.05rem; } p { margin: .4rem 0; max-width: 60rem; }
a { color: var(--accent); } .faint, .caption { color: var(--faint); font-size: .88rem; }
section.table { margin-bottom: .9rem; }
.scroll { overflow-x: auto; } table { border-collapse: collapse; font-variant-numeric: tabular-nums; font-size: .86rem; }
th, td { padding: .18rem .55rem; text-align: right; white-space: nowrap; } thead { border-bottom: 1.5px solid var(--ink); }
th.head { text-align: left; font-weight: 600; } th.group { text-align: left; border-bottom: 1px solid var(--rule); }
.first { padding-left: 1.3rem; } tbody tr:nth-child(even) { background: var(--tint); }
td.best { font-weight: 700; } td small { display: block; color: var(--faint); font-weight: 400; font-size: .78rem; line-height: 1.1; } .published { color: var(--faint); font-style: italic; }
figure { margin: 1rem 0; } figure img { max-width: 100%; height: auto; } figcaption { color: var(--faint); font-size: .88rem; }
.compact table { font-size: .8rem; } .compact th { white-space: normal; } .compact th, .compact td { padding: .18rem .4rem; }
.prose table { width: 100%; } .prose th.head { white-space: normal; vertical-align: top; } .plain tbody th.head:not(:first-child) { font-weight: 400; }
.beside figure { display: grid; grid-template-columns: minmax(0, 43rem) minmax(12rem, 1fr); gap: 1.4rem; align-items: center; }
.figures { display: flex; flex-wrap: wrap; gap: 1.2rem; align-items: flex-start; }
.status { display: inline-block; padding: 0 .5rem; border-radius: .3rem; border: 1px solid currentColor; font-size: .85rem; }
.verdict { font-size: 1.15rem; font-weight: 600; padding: .6rem .9rem; border-left: .5rem solid; max-width: none; background: var(--tint); }
.verdict.good { border-color: #0072b2; } .verdict.bad { border-color: #d55e00; }
nav { display: flex; flex-wrap: wrap; gap: .2rem 1.1rem; margin: .8rem 0; } th[aria-sort] { cursor: pointer; }
th[aria-sort=ascending]::after { content: " ▲"; } th[aria-sort=descending]::after { content: " ▼"; }
input.filter { font: inherit; padding: .1rem .5rem; margin: .3rem 0; border: 1px solid var(--rule); background: var(--paper); color: var(--ink); }
.spark { vertical-align: middle; color: var(--accent); } figure img { cursor: zoom-in; }
.pair { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 22rem), 1fr)); gap: 1.2rem; }
dialog { max-width: 96vw; max-height: 96vh; padding: .5rem; border: 0; background: #fff; } dialog img { max-width: 92vw; max-height: 88vh; }
@media print { nav, input.filter { display: none; } body { max-width: none; } .scroll { overflow: visible; } }
dl { display: grid; grid-template-columns: max-content 1fr; gap: .1rem 1rem; font-size: .86rem; } dt { color: var(--faint); } dd { margin: 0; overflow-wrap: anywhere; }
)css";

// Tables sort by a click or Enter on a heading and filter by text; a figure opens large. The page reads without it.
constexpr std::string_view kScript = R"js(
for (const table of document.querySelectorAll('table')) {
  const body = table.tBodies[0];
  if (!body || body.rows.length < 3) continue;
  const heads = [...table.tHead.rows[table.tHead.rows.length - 1].cells];
  const value = (row, c) => {
    const text = row.cells[c] ? row.cells[c].textContent.trim() : '';
    const number = parseFloat(text.replace('−', '-'));
    return isNaN(number) ? text : number;
  };
  heads.forEach((head, c) => {
    head.tabIndex = 0;
    head.setAttribute('aria-sort', 'none');
    head.title = 'sort';
    const sort = () => {
      const up = head.getAttribute('aria-sort') === 'descending';
      heads.forEach(h => h.setAttribute('aria-sort', 'none'));
      head.setAttribute('aria-sort', up ? 'ascending' : 'descending');
      const rows = [...body.rows].sort((a, b) => {
        const x = value(a, c), y = value(b, c);
        const order = typeof x === 'number' && typeof y === 'number' ? x - y : String(x).localeCompare(String(y));
        return up ? order : -order;
      });
      body.append(...rows);
    };
    head.addEventListener('click', sort);
    head.addEventListener('keydown', e => { if (e.key === 'Enter') sort(); });
  });
  if (body.rows.length < 9) continue;
  const filter = document.createElement('input');
  filter.className = 'filter';
  filter.type = 'search';
  filter.placeholder = 'filter rows';
  filter.setAttribute('aria-label', 'filter rows');
  filter.addEventListener('input', () => {
    for (const row of body.rows) row.hidden = !row.textContent.toLowerCase().includes(filter.value.toLowerCase());
  });
  table.parentElement.before(filter);
}
for (const image of document.querySelectorAll('figure img')) {
  image.tabIndex = 0;
  const open = () => {
    const dialog = document.createElement('dialog');
    const large = image.cloneNode();
    dialog.append(large);
    document.body.append(dialog);
    dialog.addEventListener('click', () => dialog.close());
    dialog.addEventListener('close', () => dialog.remove());
    dialog.showModal();
  };
  image.addEventListener('click', open);
  image.addEventListener('keydown', e => { if (e.key === 'Enter') open(); });
}
)js";

constexpr std::size_t kLargestList = 200;  ///< rows of a table of cells
constexpr std::size_t kMostRemarks = 24;   ///< rows before scenarios are taken together

/// "all 6 cells ok", "4 of 6 cells ok", "1 of 38 cells selected, all ok".
std::string outcome_text(const std::vector<CellLine>& cells) {
  const auto selected = std::ranges::count(cells, true, &CellLine::selected);
  const auto ok = std::ranges::count(cells, "ok", &CellLine::status);
  const auto all = std::ssize(cells);
  if (selected < all)
    return fmt::format("{} of {} cells selected, {} ok", selected, all, ok == selected ? "all" : std::to_string(ok));
  return ok == all ? fmt::format("all {} cells ok", all) : fmt::format("{} of {} cells ok", ok, all);
}

/// Table of the selected cells that are not ok, with one row for all seeds of a pipeline that have the same message;
/// nullopt if all are ok.
std::optional<Table> failures(const std::vector<CellLine>& cells) {
  struct Fault {
    std::vector<std::string> heads;  ///< scenario, pipeline, status, message
    std::string seed;                ///< the first
    std::size_t cells = 0;
  };
  std::vector<Fault> faults;
  std::size_t left_out = 0;
  for (const auto& cell : cells) {
    if (cell.status == "ok" || !cell.selected) continue;
    const std::vector<std::string> heads{cell.scenario, cell.pipeline, cell.status, cell.message};
    const auto same = std::ranges::find(faults, heads, &Fault::heads);
    if (same != faults.end())
      ++same->cells;
    else if (faults.size() < kLargestList)
      faults.push_back({heads, std::to_string(cell.seed), 1});
    else
      ++left_out;
  }
  if (faults.empty()) return std::nullopt;
  Table table{"failures",
              "Cells that are not ok",
              "",
              {"scenario", "pipeline", "first seed", "status", "message"},
              {{"", "cells", false}},
              {}};
  for (const auto& [heads, seed, count] : faults)
    table.rows.push_back({{heads[0], heads[1], seed, heads[2], heads[3]}, {{std::to_string(count)}}, false});
  if (left_out > 0)
    table.caption = fmt::format("And {} more; status.json of every cell has its status and message.", left_out);
  return table;
}

/// Remarks of one kind, for example "align: 1 degenerate", whose details differ from seed to seed.
struct Remark {
  std::string scenario, pipeline, kind;
  std::string first;  ///< in full
  std::size_t cells = 0;
  std::set<std::string> scenarios{};
  bool same = true;  ///< all are the first
};

/// A remark without what is in parentheses.
std::string kind_of(std::string_view remark) {
  std::string kind;
  int depth = 0;
  for (const char c : remark) {
    if (c == '(') ++depth;
    if (depth == 0) kind += c;
    if (c == ')') depth = std::max(0, depth - 1);
  }
  return kind;
}

std::vector<Remark> remarks_of(const std::vector<CellLine>& cells, bool by_scenario) {
  std::vector<Remark> remarks;
  for (const auto& cell : cells) {
    if (cell.status != "ok" || cell.message.empty()) continue;
    const std::string kind = kind_of(cell.message), scenario = by_scenario ? cell.scenario : "";
    auto found = std::ranges::find_if(remarks, [&](const Remark& r) {
      return r.scenario == scenario && r.pipeline == cell.pipeline && r.kind == kind;
    });
    if (found == remarks.end()) found = remarks.insert(found, Remark{scenario, cell.pipeline, kind, cell.message});
    ++found->cells;
    found->scenarios.insert(cell.scenario);
    found->same = found->same && cell.message == found->first;
  }
  return remarks;
}

/// Table of remarks on cells that are ok, for example that an algorithm has not converged. A row has all seeds with a
/// remark of the same kind; if that makes too many rows, also all scenarios.
std::optional<Table> remarks(const std::vector<CellLine>& cells) {
  std::vector<Remark> rows = remarks_of(cells, true);
  if (rows.size() > kMostRemarks) rows = remarks_of(cells, false);
  if (rows.empty()) return std::nullopt;
  Table table{"remarks",
              "Remarks on cells that are ok",
              "An aligner or matcher in this table has not converged on that many scans or recordings; its result is "
              "its last estimate. Where the remarks of a row differ in their details, the first is shown.",
              {"scenario", "pipeline", "remark"},
              {{"", "cells", false}},
              {}};
  if (rows.size() > kLargestList) {
    std::size_t left_out = 0;
    for (std::size_t k = kLargestList; k < rows.size(); ++k) left_out += rows[k].cells;
    table.caption += fmt::format(" And {} more cells with other remarks.", left_out);
    rows.resize(kLargestList);
  }
  for (const Remark& row : rows) {
    const std::string scenario =
        row.scenario.empty() ? fmt::format("{} scenarios", row.scenarios.size()) : row.scenario;
    const std::string remark = row.same ? row.first : "for example " + row.first;
    table.rows.push_back({{scenario, row.pipeline, remark}, {{std::to_string(row.cells)}}, false});
  }
  return table;
}

}  // namespace

std::string html_page(const std::string& title, const std::string& body) {
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n<meta name=\"viewport\" "
      "content=\"width=device-width\">\n"
      "<title>{0}</title><style>{1}</style></head>\n<body>\n<h1>{0}</h1>\n{2}<script>{3}</script></body></html>\n",
      html_escaped(title), kStyle, body, kScript);
}

std::string contents(const std::vector<std::pair<std::string, std::string>>& parts) {
  std::string out = "<nav>";
  for (const auto& [id, title] : parts)
    out += fmt::format("<a href=\"#{}\">{}</a>", html_escaped(id), html_escaped(title));
  return out + "</nav>\n";
}

std::string html_status(const std::vector<CellLine>& cells) {
  std::string out = fmt::format("<p><span class=\"status\">{}</span></p>\n", html_escaped(outcome_text(cells)));
  for (const auto& table : {failures(cells), remarks(cells)})
    if (table) out += to_html(*table);
  return out;
}

std::string markdown_status(const std::vector<CellLine>& cells) {
  std::string out = outcome_text(cells) + ".\n";
  for (const auto& table : {failures(cells), remarks(cells)})
    if (table) out += "\n" + to_markdown(*table);
  return out;
}

std::string html_figure(const std::filesystem::path& run, const FigureFile& figure, const std::string& caption) {
  if (figure.name.empty()) return "<p class=\"faint\">" + caption + "</p>\n";
  const fs::path svg = run / "figures" / (figure.name + ".svg");
  const bool is_svg = !fs::exists(svg) || fs::file_size(svg) <= kLargestSvg;
  const std::string bytes = read_file(is_svg ? svg : run / "figures" / (figure.name + ".png"));
  return fmt::format(
      "<figure><img alt=\"{0}\" src=\"data:image/{1};base64,{2}\"><figcaption>{3}</figcaption></figure>\n",
      html_escaped(figure.caption), is_svg ? "svg+xml" : "png", base64(bytes), caption);
}

std::string html_facts(const std::vector<std::pair<std::string, std::string>>& facts) {
  std::string out = "<h2 id=\"facts\">How to get these numbers again</h2>\n<dl>\n";
  for (const auto& [name, value] : facts)
    out += "<dt>" + html_escaped(name) + "</dt><dd>" + html_escaped(value) + "</dd>\n";
  return out + "</dl>\n";
}

std::string markdown_facts(const std::vector<std::pair<std::string, std::string>>& facts) {
  std::string out = "\n## How to get these numbers again\n\n";
  for (const auto& [name, value] : facts) out += "- " + name + ": " + markdown_escaped(value) + "\n";
  return out;
}

}  // namespace scanbench::harness
