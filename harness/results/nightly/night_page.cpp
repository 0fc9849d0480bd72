// Builds the page of a night.
#include "harness/results/nightly/night_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <set>
#include <utility>

#include "core/names.hpp"
#include "harness/io/files/base64.hpp"
#include "harness/results/analysis/gates.hpp"
#include "harness/results/analysis/verdict.hpp"
#include "harness/results/document/document.hpp"
#include "harness/results/document/plain_text.hpp"
#include "harness/results/document/scan_sketch.hpp"
#include "harness/results/document/sparkline.hpp"
#include "harness/results/document/table.hpp"
#include "harness/results/nightly/comparison_tables.hpp"
#include "harness/results/nightly/status_matrix.hpp"
#include "harness/results/pages/page_parts.hpp"
#include "harness/results/player/player_page.hpp"
#include "harness/results/tables/ranking_parts.hpp"

namespace scanbench::results {
namespace {

// On a phone the verdict and the first change are on the first screen.
constexpr const char* kNightStyle = R"css(<style>
@media (max-width: 600px) { body { padding: .9rem; } h1 { font-size: 1.25rem; } h2 { margin-top: 1.5rem; }
  .verdict { font-size: 1.05rem; padding: .5rem .7rem; } nav { font-size: .88rem; gap: .1rem .9rem; }
  .changes tr { grid-template-columns: 1.2fr .9fr 1.5fr .7fr; } .changes th, .changes td { padding: .15rem .3rem; } }
</style>)css";

/// "a -> b" with an arrow that no line break cuts in two.
std::string with_arrow(std::string text) {
  for (std::size_t at = 0; (at = text.find(" -> ", at)) != std::string::npos;) text.replace(at, 4, " → ");
  return text;
}

/// The answer to the question of the page, and the reasons: what is in parentheses in the first sentence, and the
/// sentences after it.
std::pair<std::string, std::string> answer_and_reasons(const std::string& sentence) {
  const std::size_t end = sentence.find(". "), aside = sentence.find(" ("), closed = sentence.find(").");
  if (aside < end && closed != std::string::npos)
    return {sentence.substr(0, aside) + ".",
            "Gates: " + sentence.substr(aside + 2, closed - aside - 2) + sentence.substr(closed + 1)};
  if (end == std::string::npos) return {sentence, ""};
  return {sentence.substr(0, end + 1), sentence.substr(end + 2)};
}

Blocks verdict_blocks(const NightInput& input) {
  const auto [answer, reasons] = answer_and_reasons(input.sentence);
  Blocks blocks;
  if (!reasons.empty()) blocks.push_back(Paragraph{reasons});
  if (!input.now.overrides.empty())
    blocks.push_back(
        Paragraph{fmt::format("This night ran with --set {}. It is in no trend, and no later night is "
                              "compared with it.",
                              join(input.now.overrides))});
  if (input.comparison) blocks.push_back(Paragraph{"Compared with " + input.reference + "."});
  if (input.drift)
    blocks.push_back(Paragraph{
        fmt::format("Against the oldest baseline, {}: {}", input.drift_reference, verdict_sentence(*input.drift))});
  if (input.comparison && !input.comparison->differing.empty()) {
    const auto& differing = input.comparison->differing;
    constexpr std::size_t kNamed = 3;
    Prose text{"What differs: "};
    for (std::size_t i = 0; i < differing.size() && i < kNamed; ++i)
      text.spans.emplace_back((i > 0 ? "; " : "") + with_arrow(differing[i]));
    if (differing.size() > kNamed) {
      text.spans.emplace_back("; ");
      text.spans.push_back(link(fmt::format("and {} more", differing.size() - kNamed), "#differs-section"));
    }
    blocks.push_back(Paragraph{text});
  }
  blocks.push_back(Paragraph{reuse_text(input.now.cells.size(), input.reused), "faint"});
  return blocks;
}

Blocks differing_blocks(const std::vector<std::string>& differing) {
  if (differing.empty()) return {};
  BulletList list;
  for (const auto& difference : differing) list.items.emplace_back(with_arrow(difference));
  return {std::move(list)};
}

Blocks picture_blocks(const std::vector<PicturePair>& pairs, const std::string& player) {
  Blocks blocks;
  for (const auto& pair : pairs) {
    BlockGroup shown{"pair", {}};
    for (const auto& picture : {pair.before, pair.now})
      if (picture)
        shown.blocks.push_back(Picture{.alt = picture->caption,
                                       .caption = picture->caption,
                                       .data = "data:image/png;base64," + io::base64(picture->png)});
    blocks.push_back(Heading{3, pair.title});
    Prose note{pair.note};
    if (pair.scan && !player.empty())
      note.spans.insert(note.spans.end(),
                        {" ", link("Open it in the player.", player_address(pair.scan->cell, pair.scan->frame))});
    if (!pair.note.empty()) blocks.push_back(Paragraph{std::move(note)});
    if (!shown.blocks.empty()) blocks.push_back(std::move(shown));
  }
  return blocks;
}

/// The scans that show what became worse, with the key to their colours.
Blocks scan_blocks(const std::vector<PicturePair>& scans, const std::string& player) {
  if (scans.empty()) return {};
  Blocks blocks{Heading{3, "The scans that show it"}};
  if (std::ranges::any_of(scans, &PicturePair::needs_key))
    add_blocks(blocks, {Markup{scan_sketch_key()},
                        Paragraph{"Grey below the lines: true walls. Dots: the returns of the scan.", "caption"}});
  add_blocks(blocks, picture_blocks(scans, player));
  return blocks;
}

std::string better_text(const metrics::MetricDescription& metric) {
  switch (metric.direction) {
    case metrics::Direction::higher_is_better:
      return "↑ higher";
    case metrics::Direction::lower_is_better:
      return "↓ lower";
    case metrics::Direction::target:
      return fmt::format("near {:.4g}", metric.target);
    case metrics::Direction::neither:
      break;
  }
  return "–";
}

/// Spark lines of the changes that the page lists, with the values at their lower and upper edge.
Blocks trend_blocks(const NightInput& input) {
  const auto descriptions = metric_descriptions();
  Table table{"trends-table",
              "",
              "",
              {"scenario/pipeline/metric"},
              {{"", "better"},
               {"", "trend"},
               {"", "from low to high"},
               {"", "first"},
               {"", "now"},
               {"", "unit"},
               {"", "nights"}},
              {}};
  for (const auto& [name, points] : input.trends) {
    if (points.size() < 2) continue;
    std::vector<double> values;
    for (const auto& point : points) values.push_back(point.value);
    const auto [low, high] = std::ranges::minmax(values);
    const auto known = descriptions.find(name.substr(name.rfind('/') + 1));
    const metrics::MetricDescription metric =
        known == descriptions.end() ? metrics::MetricDescription{} : known->second;
    table.rows.push_back({{name},
                          {{better_text(metric)},
                           {.text = "", .drawing = sparkline(values, name + " over the last nights")},
                           {fmt::format("{:.4g} … {:.4g}", low, high)},
                           {fmt::format("{:.4g}", values.front())},
                           {fmt::format("{:.4g}", values.back())},
                           {metric.unit},
                           {fmt::format("{} since {}", points.size(), points.front().start.substr(0, 10))}},
                          false});
  }
  if (table.rows.empty()) return {};
  return {std::move(table)};
}

/// Twelve digits; "(changed)" for a program whose code was not that of the commit.
std::string commit_text(const std::string& commit) {
  return commit.substr(0, 12) + (commit.find("-dirty-") == std::string::npos ? "" : " (changed)");
}

Blocks history_blocks(const NightInput& input) {
  constexpr std::size_t kShown = 30;
  Table table{"nights", "", "", {"start (UTC)", "commit", "verdict"}, {}, {}};
  for (std::size_t i = input.nights.size(); i-- > 0 && table.rows.size() < kShown;) {
    const Night& night = input.nights[i];
    const std::string mark = night.overrides.empty() ? "" : "with --set " + night.overrides + ": ";
    table.rows.push_back({{night.start, commit_text(night.commit), mark + night.sentence}, {}, false});
  }
  if (table.rows.size() < 2) return {};
  return {BlockGroup{"nights", {std::move(table)}}};
}

Blocks definition_blocks(const NightInput& input) {
  std::set<std::string> used;
  if (input.comparison)
    for (const auto& change : input.comparison->changes) used.insert(change.metric.metric);
  for (const auto& ranking : input.rankings) used.insert(ranking.quality.metric);
  Definitions definitions = definitions_of(used);
  if (definitions.items.empty()) return {};
  return {std::move(definitions)};
}

Picture sketch_of(const WorstScan& scan, const NightInput& input) {
  const std::string command =
      fmt::format("scanbench show {} --scenario {} --pipeline {} --seed {} --frame {}", shell_word(input.now.name),
                  scan.key.scenario, scan.key.pipeline, scan.key.seed, scan.frame);
  const std::string name = fmt::format("{}, seed {}, scan {}", scan.key.scenario, scan.key.seed, scan.frame);
  const std::string counts = fmt::format(
      ": F1 {:.2f}, {} right, {} false, {} missed, {} split{}", scan.f1, scan.found, scan.false_lines, scan.missed,
      scan.split, scan.unjudged > 0 ? fmt::format(", {} too short to judge", scan.unjudged) : "");
  return {.alt = name,
          .caption = {link(name,
                           input.player.empty() ? "cells/" + runs::to_string(scan.key) + "/"
                                                : player_address(scan.key, scan.frame),
                           command),
                      counts},
          .drawing = scan.sketch};
}

/// The worst scans of each pipeline, each with the command that draws it large.
Blocks worst_blocks(const NightInput& input) {
  if (input.worst.empty()) return {};
  Blocks blocks{Paragraph{std::string("Lowest F1 over all scenarios and seeds first. ") +
                          (input.player.empty() ? "" : "A name leads to the scan in the player. ") +
                          "The pointer on it shows the command that draws the scan large."},
                Markup{scan_sketch_key()}};
  for (const auto& [pipeline, scans] : input.worst) {
    BlockGroup sketches{"scans", {}};
    for (const auto& scan : scans) sketches.blocks.push_back(sketch_of(scan, input));
    blocks.push_back(Heading{3, pipeline});
    blocks.push_back(std::move(sketches));
  }
  return blocks;
}

Blocks file_blocks(const NightInput& input) {
  BulletList files;
  if (!input.report.empty())
    files.items.push_back(
        {link("The report of this run", input.report), ": every scenario with its tables and figures"});
  if (!input.player.empty()) files.items.push_back({link("The scans of this run", input.player), ", to be played"});
  for (const auto& file : input.files) files.items.push_back({link(file, file)});
  if (files.items.empty()) return {};
  return {Paragraph{"Beside this page in the run folder:"}, std::move(files)};
}

/// The table of that id. The page's own heading is above it, unless it has `own_title`.
Blocks change_blocks(const Comparison& comparison, const std::string& id, bool own_title = false) {
  for (auto& table : comparison_tables(comparison)) {
    if (table.id != id) continue;
    if (!own_title) table.title.clear();
    return {BlockGroup{"changes", {std::move(table)}}};
  }
  return {};
}

Blocks completeness_blocks(const Comparison& comparison) {
  auto table = completeness_table(comparison);
  if (!table) return {};
  table->title.clear();
  return {std::move(*table)};
}

/// "No gate is worse.", and where cells are not ok, that nothing was compared there.
Paragraph nothing_worse(const Comparison& comparison) {
  const std::size_t failed = comparison.broken.size() + comparison.failing.size();
  if (failed == 0 && comparison.missing.empty()) return {"No gate is worse."};
  return {"No gate of the cells that could be compared is worse."};
}

Blocks worse_blocks(const NightInput& input) {
  Blocks blocks = change_blocks(*input.comparison, "worse");
  if (blocks.empty()) blocks.push_back(nothing_worse(*input.comparison));
  add_blocks(blocks, scan_blocks(input.pictures.scans, input.player));
  add_blocks(blocks, change_blocks(*input.comparison, "uncertain", true));
  add_blocks(blocks, change_blocks(*input.comparison, "watched", true));
  return blocks;
}

std::vector<Section> sections_of(const NightInput& input) {
  std::vector<Section> sections;
  if (const auto& comparison = input.comparison) {
    Section cells{"cells-section", "Cells that are not ok, new or gone", completeness_blocks(*comparison)};
    Section better{"better-section", "What became better", change_blocks(*comparison, "better")};
    const bool cells_first = !comparison->broken.empty() || !comparison->failing.empty() || comparison->incomplete();
    if (cells_first) sections.push_back(std::move(cells));
    sections.push_back({"worse-section", "What became worse", worse_blocks(input)});
    sections.push_back(std::move(better));
    if (!cells_first) sections.push_back(std::move(cells));
    sections.push_back({"matrix-section", "Pipelines × scenarios",
                        status_matrices(input.now, *comparison, input.rankings, input.scenarios_page)});
    sections.push_back(
        {"figures-section", "Figures of what became worse", picture_blocks(input.pictures.figures, input.player)});
    sections.push_back({"differs-section", "What differs", differing_blocks(comparison->differing)});
  }
  for (Section& section :
       std::vector<Section>{{"rankings-section", "Rankings, and accuracy against time",
                             ranking_blocks(input.rankings, input.scenarios_page)},
                            {"worst-section", "The worst scans of each pipeline", worst_blocks(input)},
                            {"trends-section", "Trends", trend_blocks(input)},
                            {"nights-section", "Nights", history_blocks(input)},
                            {"files-section", "Files", file_blocks(input)},
                            {"definitions-section", "What the metrics mean", definition_blocks(input)}})
    sections.push_back(std::move(section));
  return sections;
}

}  // namespace

std::string reuse_text(std::size_t cells, std::size_t reused) {
  if (reused == 0)
    return cells == 1 ? "1 cell, run in this night." : fmt::format("{} cells, all run in this night.", cells);
  return fmt::format("{} of {} cells were not run again, because nothing in them changed.", reused, cells);
}

Document night_document(const NightInput& input) {
  std::set<std::uint64_t> seeds;
  for (const CellResults& cell : input.now.cells) seeds.insert(cell.key.seed);
  const auto started = std::ranges::find(input.facts, "started", &std::pair<std::string, std::string>::first);
  const std::string date = started == input.facts.end() ? "" : " of " + started->second.substr(0, 10);
  Document page{.title = words_of_name(input.suite) + ", night" + date,
                .blocks = verdict_blocks(input),
                .lead = answer_and_reasons(input.sentence).first,
                .lead_style = input.sentence.starts_with("PASS") ? "verdict good" : "verdict bad",
                .stamp = stamp_of(input.facts, {seeds.begin(), seeds.end()})};
  page.blocks.emplace_back(Markup{kNightStyle});
  add_blocks(page.blocks, section_blocks(sections_of(input), input.facts));
  return page;
}

}  // namespace scanbench::results
