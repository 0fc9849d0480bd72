// Writes the report of a run: tables, figures, and how to get the numbers again.
#include "harness/report/report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/registry.hpp"
#include "harness/page/html_page.hpp"
#include "harness/page/plain_text.hpp"
#include "harness/report/page_parts.hpp"
#include "harness/report/ranking_parts.hpp"
#include "harness/report/recording_note.hpp"
#include "harness/report/scenario_tables.hpp"
#include "metrics/metric.hpp"

namespace scanbench::harness {
namespace {

constexpr std::size_t kPageWidth = 136;  // characters of a table that fit the page

/// "segments, efficiency have no values": the metric families of a scenario without any row; empty if all have, or
/// none.
std::string families_without_values(const ReportInput& input, const Scenario& scenario) {
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
std::string no_truth_text(const ReportInput& input, const Scenario& scenario) {
  const std::string silent = families_without_values(input, scenario);
  return "There is no truth" + (silent.empty() ? "" : ": " + silent);
}

std::string input_text(const ReportInput& input, const Scenario& scenario) {
  if (const auto* simulated = std::get_if<SimulatedInput>(&scenario.input)) {
    return fmt::format("World {} with {} walls, {}, trajectory {}, {} seed{}.", simulated->world.name,
                       simulated->world.walls.size(), condition_text(scenario), simulated->trajectory.module,
                       scenario.seeds.size(), scenario.seeds.size() == 1 ? "" : "s");
  }
  if (const auto* lines = std::get_if<LinesInput>(&scenario.input)) {
    if (!lines->file.empty())
      return fmt::format("Lines of {}{}.", lines->file_name,
                         lines->world ? ", with world " + lines->world->name + " as the truth"
                                      : ". " + no_truth_text(input, scenario));
    return fmt::format("{} copies of the {} walls of world {}, {} seed{}.", lines->copies.copies,
                       lines->world->walls.size(), lines->world->name, scenario.seeds.size(),
                       scenario.seeds.size() == 1 ? "" : "s");
  }
  const auto& recorded = std::get<RecordedInput>(scenario.input);
  const auto source = input.sources.find(scenario.name);
  const std::string errors = recorded.odometry.any()
                                 ? fmt::format(" Its poses get errors that follow the seed, {} seed{}.",
                                               scenario.seeds.size(), scenario.seeds.size() == 1 ? "" : "s")
                                 : "";
  return fmt::format("Recorded log {} ({}{}).{} {}.", recorded.log.filename().string(), recorded.format,
                     source == input.sources.end() ? "" : "; " + source->second, errors,
                     no_truth_text(input, scenario));
}

std::vector<FigureFile> figures_of(const ReportInput& input, const std::string& scenario) {
  std::vector<FigureFile> figures;
  for (const auto& figure : input.figures)
    if (figure.scenario == scenario) figures.push_back(figure);
  return figures;
}

/// The values that a reader asks for first, with a link to each scenario.
std::string html_overview(const ReportInput& input) {
  std::string out;
  bool has_chart = false;
  for (const auto& scenario : input.scenarios) {
    auto table = scenario_overview(scenario, input.rows, input.cells);
    if (!table) continue;
    table->id = scenario.name + "-overview";
    const std::string answer = scenario_answer(scenario, input.rows, input.cells, *table);
    out += fmt::format("<p><a href=\"#{0}\">{0}</a>{1}</p>\n", html_escaped(scenario.name),
                       answer.empty() ? "" : ": " + html_escaped(answer));
    out += "<div class=\"glance\">\n";
    for (const auto& part : parts_of_width(*table, kPageWidth)) out += to_html(part);
    if (const auto ranking = input.rankings.find(scenario.name); ranking != input.rankings.end()) {
      const std::string chart = accuracy_chart(ranking->second);
      has_chart = has_chart || !chart.empty();
      out += chart;
    }
    out += "</div>\n";
  }
  if (has_chart)
    out +=
        "<p class=\"caption\">In the charts, ● on the dashed line: no other pipeline is both as good and as fast. "
        "○: another is.</p>\n";
  return out;
}

/// Links to the tables and figures of a scenario.
std::string html_contents(const std::vector<Table>& tables, const Scenario& scenario, bool has_figures) {
  std::vector<std::pair<std::string, std::string>> parts;
  for (const auto& table : tables) {
    const bool named = table.title.starts_with(scenario.name + ": ");
    parts.emplace_back(table.id, named ? table.title.substr(scenario.name.size() + 2) : table.title);
  }
  if (has_figures) parts.emplace_back(scenario.name + "-figures", "figures");
  return contents(parts);
}

}  // namespace

std::string report_html(const ReportInput& input) {
  std::string out = html_status(input.cells);
  std::vector<std::pair<std::string, std::string>> chapters;
  for (const auto& scenario : input.scenarios) chapters.emplace_back(scenario.name, scenario.name);
  chapters.emplace_back("definitions", "what the metrics mean");
  chapters.emplace_back("facts", "how to get these numbers again");
  out += contents(chapters) + html_overview(input) + html_remarks(input.cells);
  for (const auto& scenario : input.scenarios) {
    out += fmt::format("<h2 id=\"{0}\">{0}</h2>\n<p>{1}</p>\n<p class=\"faint\">{2}</p>\n", html_escaped(scenario.name),
                       html_escaped(scenario.about), html_escaped(input_text(input, scenario)));
    std::vector<Table> tables = scenario_tables(scenario, input.rows, input.cells, TableDetail::departures);
    for (auto& table : tables) table.id = scenario.name + "-" + table.id;  // other scenarios have the same tables
    const auto figures = figures_of(input, scenario.name);
    out += html_contents(tables, scenario, !figures.empty());
    if (!figures.empty())
      out += fmt::format("<div class=\"figures\" id=\"{}-figures\">\n", html_escaped(scenario.name));
    for (const auto& figure : figures) out += html_figure(input.run, figure, html_escaped(figure.caption));
    if (!figures.empty()) out += "</div>\n";
    for (const auto& table : tables)
      for (const auto& part : parts_of_width(table, kPageWidth)) out += to_html(part);
  }
  std::set<std::string> metrics;
  for (const auto& row : input.rows) metrics.insert(row.metric);
  const std::string definitions = html_definitions(metrics);
  out += "<h2 id=\"definitions\">What the metrics mean</h2>\n" +
         (definitions.empty() ? "<p>There are no values.</p>\n" : definitions);
  return html_page(input.title, out + html_facts(input.facts));
}

std::string report_markdown(const ReportInput& input) {
  std::string out = "# " + input.title + "\n\n" + markdown_status(input.cells);
  for (const auto& scenario : input.scenarios)
    if (const auto table = scenario_overview(scenario, input.rows, input.cells)) {
      const std::string answer = scenario_answer(scenario, input.rows, input.cells, *table);
      if (!answer.empty())
        out += fmt::format("\n**{}**: {}\n", markdown_escaped(scenario.name), markdown_escaped(answer));
      out += "\n" + to_markdown(*table);
    }
  out += markdown_remarks(input.cells);
  for (const auto& scenario : input.scenarios) {
    out += "\n## " + scenario.name + "\n\n" + markdown_escaped(scenario.about) + "\n\n" +
           markdown_escaped(input_text(input, scenario)) + "\n";
    for (const auto& table : scenario_tables(scenario, input.rows, input.cells, TableDetail::departures))
      out += "\n" + to_markdown(table);
    for (const auto& figure : figures_of(input, scenario.name))
      out += figure.name.empty()
                 ? "\n" + markdown_escaped(figure.caption) + "\n"
                 : fmt::format("\n![{0}](figures/{1}.svg)\n\n{0}\n", markdown_escaped(figure.caption), figure.name);
  }
  return out + markdown_facts(input.facts);
}

}  // namespace scanbench::harness
