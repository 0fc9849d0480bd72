// Builds the report of a run: tables, figures, and how to get the numbers again.
#include "harness/results/pages/report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/names.hpp"
#include "core/registry.hpp"
#include "harness/results/document/plain_text.hpp"
#include "harness/results/figures/recording_note.hpp"
#include "harness/results/pages/page_parts.hpp"
#include "harness/results/pages/run_links.hpp"
#include "harness/results/tables/ranking_parts.hpp"
#include "harness/results/tables/results_table.hpp"
#include "harness/results/tables/scenario_tables.hpp"
#include "harness/results/tables/table_marks.hpp"
#include "metrics/metric.hpp"

namespace scanbench::results {
namespace {

namespace fs = std::filesystem;

/// "segments, efficiency have no values": the metric families of a scenario without any row; empty if all have, or
/// none.
std::string families_without_values(const ReportInput& input, const study::Scenario& scenario) {
  std::set<std::string> reported;
  for (const auto& row : input.rows)
    if (row.scenario == scenario.name) reported.insert(row.metric);
  if (reported.empty()) return "";  // the cells failed
  std::vector<std::string> silent;
  for (const auto& choice : scenario.metrics) {
    const auto metrics = Registry<metrics::MetricFamily>::make(choice.module, choice.params)->describe();
    if (std::ranges::none_of(metrics, [&](const auto& metric) { return reported.contains(metric.metric); }))
      silent.push_back(choice.module);
  }
  if (silent.empty()) return "";
  return fmt::format("{} {} no values", fmt::join(silent, ", "), silent.size() == 1 ? "has" : "have");
}

/// "There is no truth: segments has no values."
std::string no_truth_text(const ReportInput& input, const study::Scenario& scenario) {
  const std::string silent = families_without_values(input, scenario);
  return "There is no truth" + (silent.empty() ? "" : ": " + silent);
}

std::string input_text(const ReportInput& input, const study::Scenario& scenario) {
  if (const auto* simulated = std::get_if<study::SimulatedInput>(&scenario.input)) {
    return fmt::format("World {} with {} walls, {}, trajectory {}, {} seed{}.", simulated->world.name,
                       simulated->world.walls.size(), condition_text(scenario), simulated->trajectory.module,
                       scenario.seeds.size(), scenario.seeds.size() == 1 ? "" : "s");
  }
  if (const auto* lines = std::get_if<study::LinesInput>(&scenario.input)) {
    if (!lines->file.empty())
      return fmt::format("Lines of {}{}.", lines->file_name,
                         lines->world ? ", with world " + lines->world->name + " as the truth"
                                      : ". " + no_truth_text(input, scenario));
    return fmt::format("{} copies of the {} walls of world {}, {} seed{}.", lines->copies.copies,
                       lines->world->walls.size(), lines->world->name, scenario.seeds.size(),
                       scenario.seeds.size() == 1 ? "" : "s");
  }
  const auto& recorded = std::get<study::RecordedInput>(scenario.input);
  const auto source = input.sources.find(scenario.name);
  const std::string errors = recorded.odometry.any()
                                 ? fmt::format(" Its poses get errors that follow the seed, {} seed{}.",
                                               scenario.seeds.size(), scenario.seeds.size() == 1 ? "" : "s")
                                 : "";
  return fmt::format("Recorded log {} ({}{}).{} {}.", recorded.log.filename().string(), recorded.format,
                     source == input.sources.end() ? "" : "; " + source->second, errors,
                     no_truth_text(input, scenario));
}

/// "In 12 scenarios sef has or shares the best result 7 times, iepf 5 times."
std::string counted_answer(const ReportInput& input) {
  constexpr std::size_t kMostNamed = 3;
  std::vector<std::pair<std::string, std::size_t>> wins;  // in the order of the first win
  for (const auto& scenario : input.scenarios) {
    const auto& overview = input.results.at(scenario.name).overview;
    if (!overview) continue;
    for (const std::string& name : best_pipelines(*overview)) {
      auto win = std::ranges::find(wins, name, &std::pair<std::string, std::size_t>::first);
      if (win == wins.end()) win = wins.insert(win, {name, 0});
      ++win->second;
    }
  }
  if (wins.empty()) return fmt::format("In none of {} scenarios is a pipeline called best.", input.scenarios.size());
  std::ranges::stable_sort(wins, std::ranges::greater(), &std::pair<std::string, std::size_t>::second);
  std::vector<std::string> parts;
  for (std::size_t k = 0; k < std::min(wins.size(), kMostNamed); ++k)
    parts.push_back(
        fmt::format("{} {}", wins[k].first, wins[k].second == 1 ? "once" : fmt::format("{} times", wins[k].second)));
  return fmt::format("In {} scenarios the best result is of, or shared by: {}{}.", input.scenarios.size(),
                     fmt::join(parts, ", "),
                     wins.size() > kMostNamed ? fmt::format(", and {} more pipelines", wins.size() - kMostNamed) : "");
}

/// What was found, in a sentence.
std::string answer_of(const ReportInput& input) {
  if (input.scenarios.size() != 1) return counted_answer(input);
  const std::string& answer = input.results.at(input.scenarios.front().name).answer;
  return answer.empty() ? "There are no values to compare." : answer;
}

/// The most important values, with a link to each scenario. The answer of an only scenario is the page's first
/// sentence.
Blocks overview_blocks(const ReportInput& input) {
  Blocks blocks;
  bool has_chart = false;
  const bool only = input.scenarios.size() == 1;
  for (const auto& scenario : input.scenarios) {
    const ScenarioResults& results = input.results.at(scenario.name);
    if (!results.overview) continue;
    if (!only)
      blocks.push_back(
          Paragraph{{link(scenario.name, "#" + scenario.name), results.answer.empty() ? "" : ": " + results.answer}});
    Table table = *results.overview;
    table.id = scenario.name + "-overview";
    if (only) table.title = "At a glance";
    link_pipelines(table, scenario.name, input.cells);
    BlockGroup glance{"glance", {std::move(table)}};
    if (const auto ranking = input.rankings.find(scenario.name); ranking != input.rankings.end()) {
      const std::string chart = accuracy_chart(ranking->second);
      has_chart = has_chart || !chart.empty();
      glance.blocks.push_back(Markup{chart});
    }
    blocks.push_back(std::move(glance));
  }
  if (!blocks.empty()) blocks.push_back(Markup{fmt::format("<p class=\"caption\">{}</p>\n", kArrowKey)});
  if (has_chart)  // only HTML has charts
    blocks.push_back(
        Markup{"<p class=\"caption\">In the charts, ● on the dashed line: no other pipeline is both as good "
               "and as fast. ○: another is.</p>\n"});
  return blocks;
}

/// Links to the tables and figures of a scenario.
ContentLinks links_to(const std::vector<Table>& tables, const study::Scenario& scenario, bool has_figures) {
  ContentLinks links;
  for (const auto& table : tables) {
    const bool named = table.title.starts_with(scenario.name + ": ");
    links.places.emplace_back(table.id, named ? table.title.substr(scenario.name.size() + 2) : table.title);
  }
  if (has_figures) links.places.emplace_back(scenario.name + "-figures", "figures");
  return links;
}

Blocks chapter_of(const ReportInput& input, const study::Scenario& scenario) {
  std::vector<Table> tables = input.results.at(scenario.name).tables;
  for (auto& table : tables) {
    table.id = scenario.name + "-" + table.id;  // other scenarios have the same tables
    link_pipelines(table, scenario.name, input.cells);
  }
  BlockGroup figures{.style = "figures", .blocks = {}, .id = scenario.name + "-figures"};
  for (const auto& figure : input.figures)
    if (figure.scenario == scenario.name) figures.blocks.push_back(run_picture(input.run, figure));
  Blocks blocks{Heading{2, scenario.name, scenario.name}};
  if (!scenario.about.empty()) blocks.push_back(Paragraph{scenario.about});
  blocks.push_back(Paragraph{input_text(input, scenario), "faint"});
  if (fs::exists(input.run / kScansPage))
    blocks.push_back(Paragraph{{link("Play its scans", fmt::format("{}#{}", kScansPage, scenario.name)),
                                " with the lines that each pipeline found."}});
  blocks.push_back(links_to(tables, scenario, !figures.blocks.empty()));
  if (std::string note = bound_note(scenario); !note.empty()) blocks.push_back(Paragraph{std::move(note)});
  if (!figures.blocks.empty()) blocks.push_back(std::move(figures));
  for (auto& table : tables) blocks.push_back(std::move(table));
  return blocks;
}

Blocks meaning_of_metrics(const std::vector<runs::SummaryRow>& rows) {
  std::set<std::string> metrics;
  for (const auto& row : rows) metrics.insert(row.metric);
  Blocks blocks{Heading{2, "What the metrics mean", "definitions"}};
  if (Definitions definitions = definitions_of(metrics); !definitions.items.empty())
    blocks.push_back(std::move(definitions));
  else
    blocks.push_back(Paragraph{"There are no values."});
  return blocks;
}

}  // namespace

std::string report_title(const std::vector<study::Scenario>& scenarios) {
  constexpr std::size_t kMostNamed = 2;
  if (scenarios.empty()) return "A run without scenarios";
  if (scenarios.size() == 1) {
    const std::string title = words_of_name(scenarios.front().name);
    const auto* recorded = std::get_if<study::RecordedInput>(&scenarios.front().input);
    return recorded == nullptr ? title : fmt::format("{}: log {}", title, recorded->log.filename().string());
  }
  std::vector<std::string> names;
  for (std::size_t k = 0; k < std::min(scenarios.size(), kMostNamed); ++k)
    names.push_back(words_of_name(scenarios[k].name));
  if (scenarios.size() > kMostNamed) names.push_back(fmt::format("{} more", scenarios.size() - kMostNamed));
  return fmt::format("{} scenarios: {}", scenarios.size(), fmt::join(names, ", "));
}

Document report_document(const ReportInput& input) {
  Blocks chapters;
  for (const auto& scenario : input.scenarios) add_blocks(chapters, chapter_of(input, scenario));
  add_blocks(chapters, meaning_of_metrics(input.rows));
  add_blocks(chapters, fact_blocks(input.facts));
  chapters.push_back(Heading{2, "Files", "files"});
  add_blocks(chapters, file_blocks(input.run, input.cells));
  Document page{.title = report_title(input.scenarios),
                .blocks = status_blocks(input.cells),
                .lead = answer_of(input),
                .stamp = stamp_of(input.facts, seeds_of(input.rows))};
  page.blocks.push_back(contents_of(chapters));
  add_blocks(page.blocks, overview_blocks(input));
  add_blocks(page.blocks, remark_blocks(input.cells));
  add_blocks(page.blocks, std::move(chapters));
  return page;
}

}  // namespace scanbench::results
