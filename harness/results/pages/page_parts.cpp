// Makes the parts that the pages of runs and benchmarks share.
#include "harness/results/pages/page_parts.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "harness/io/files/atomic_file.hpp"
#include "harness/io/files/base64.hpp"
#include "harness/results/analysis/gates.hpp"
#include "harness/results/document/table.hpp"
#include "harness/results/pages/run_links.hpp"

namespace scanbench::results {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kLargestSvg = std::uintmax_t{8} << 20;  // a larger one is shown as PNG, which is smaller

constexpr std::size_t kLargestList = 200;  ///< rows of a table of cells
constexpr std::size_t kMostRemarks = 24;   ///< rows before scenarios are taken together

/// "all 6 cells ok", "4 of 6 cells ok", "1 of 38 cells selected, all ok".
std::string outcome_text(const std::vector<CellLine>& cells) {
  const auto selected = std::ranges::count(cells, true, &CellLine::selected);
  const auto ok = std::ranges::count(cells, "ok", &CellLine::status);
  const auto all = std::ssize(cells);
  if (selected < all)
    return fmt::format("{} of {} cells selected, {} ok", selected, all, ok == selected ? "all" : std::to_string(ok));
  if (ok == all && all == 1) return "the only cell is ok";
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

/// A remark without its numbers and without what is in parentheses.
std::string kind_of(std::string_view remark) {
  std::string kind;
  int depth = 0;
  for (const char c : remark) {
    if (c == '(') ++depth;
    if (depth == 0 && (c < '0' || c > '9')) kind += c;
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
  Table table{
      "remarks",
      "Remarks on cells that are ok",
      "Numbers of scans (of recordings, for an aligner) whose status is not converged. max_iterations: not converged, "
      "the pose is the last estimate. degenerate: the scans leave a motion open, and the pose along it is that of the "
      "guess. no_match: the pose is the guess. Where the remarks of a row differ in their details, the first is shown.",
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
    const std::string scenario = !row.scenario.empty()       ? row.scenario
                                 : row.scenarios.size() == 1 ? *row.scenarios.begin()
                                                             : fmt::format("{} scenarios", row.scenarios.size());
    const std::string remark = row.same ? row.first : "for example " + row.first;
    table.rows.push_back({{scenario, row.pipeline, remark}, {{std::to_string(row.cells)}}, false});
  }
  return table;
}

}  // namespace

Blocks status_blocks(const std::vector<CellLine>& cells) {
  Blocks blocks{Paragraph{outcome_text(cells), "status"}};
  if (auto table = failures(cells)) blocks.push_back(BlockGroup{"prose plain", {std::move(*table)}});
  return blocks;
}

Blocks remark_blocks(const std::vector<CellLine>& cells) {
  Blocks blocks;
  if (auto table = remarks(cells)) blocks.push_back(BlockGroup{"prose plain", {std::move(*table)}});
  return blocks;
}

Picture run_picture(const std::filesystem::path& run, const FigureFile& figure, const std::string& number) {
  Picture picture{.alt = figure.caption, .caption = figure_caption(run, figure)};
  if (!number.empty()) picture.caption.spans.insert(picture.caption.spans.begin(), {bold(number + "."), " "});
  if (figure.name.empty()) return picture;
  const fs::path svg = run / "figures" / (figure.name + ".svg");
  const bool is_svg = !fs::exists(svg) || fs::file_size(svg) <= kLargestSvg;
  const std::string bytes = io::read_file(is_svg ? svg : run / "figures" / (figure.name + ".png"));
  picture.address = "figures/" + figure.name + ".svg";
  picture.data = fmt::format("data:image/{};base64,{}", is_svg ? "svg+xml" : "png", io::base64(bytes));
  return picture;
}

Definitions definitions_of(const std::set<std::string>& metrics) {
  const auto descriptions = metric_descriptions();
  Definitions definitions;
  for (const auto& metric : metrics) {
    const auto found = descriptions.find(metric);
    if (found == descriptions.end()) continue;
    const std::string unit = found->second.unit.empty() ? "" : " [" + found->second.unit + "]";
    const std::string& label = found->second.label;
    definitions.items.emplace_back((label == metric ? metric : label + ", " + metric) + unit, found->second.doc);
  }
  return definitions;
}

}  // namespace scanbench::results
