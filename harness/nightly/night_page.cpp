// Writes the page of a night.
#include "harness/nightly/night_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "harness/analysis/gates.hpp"
#include "harness/analysis/verdict.hpp"
#include "harness/files/base64.hpp"
#include "harness/nightly/comparison_tables.hpp"
#include "harness/nightly/sparkline.hpp"
#include "harness/report/html_page.hpp"
#include "harness/report/plain_text.hpp"
#include "harness/report/table.hpp"

namespace scanbench::harness {
namespace {

std::string escaped(const std::string& text) {
  return html_escaped(plain_text(text));
}

std::string verdict_banner(const NightInput& input) {
  std::string out = fmt::format("<p class=\"verdict {}\">{}</p>\n", input.sentence.starts_with("PASS") ? "good" : "bad",
                                escaped(input.sentence));
  if (input.comparison) out += "<p>Compared with " + escaped(input.reference) + ".</p>\n";
  if (input.drift)
    out += fmt::format("<p>Against the oldest baseline, {}: {}</p>\n", escaped(input.drift_reference),
                       escaped(verdict_sentence(*input.drift)));
  out +=
      fmt::format("<p class=\"faint\">{} cells, of which {} were not run again, because nothing in them changed.</p>\n",
                  input.now.cells.size(), input.reused);
  return out;
}

std::string list_of(const std::vector<std::string>& items) {
  if (items.empty()) return "";
  std::string out = "<ul>\n";
  for (const auto& item : items) out += "<li>" + escaped(item) + "</li>\n";
  return out + "</ul>\n";
}

std::string picture(const std::optional<ScanPicture>& scan) {
  if (!scan) return "";
  return fmt::format(
      "<figure><img alt=\"{0}\" src=\"data:image/png;base64,{1}\"><figcaption>{0}</figcaption></figure>\n",
      escaped(scan->caption), base64(scan->png));
}

std::string pictures(const NightInput& input) {
  std::string out;
  for (const auto& pair : input.pictures)
    out += "<h3>" + escaped(pair.title) + "</h3>\n<div class=\"pair\">\n" + picture(pair.before) + picture(pair.now) +
           "</div>\n";
  return out;
}

/// Spark lines of the changes that the page lists.
std::string trends(const NightInput& input) {
  std::string out;
  for (const auto& [name, points] : input.trends) {
    if (points.size() < 2) continue;
    std::vector<double> values;
    for (const auto& point : points) values.push_back(point.value);
    out += fmt::format("<tr><th class=\"head\">{}</th><td>{}</td><td>{:.4g}</td><td>{:.4g}</td><td>{}</td></tr>\n",
                       escaped(name), sparkline(values, name + " over the last nights"), values.front(), values.back(),
                       points.size());
  }
  if (out.empty()) return "";
  return "<div class=\"scroll\"><table><thead><tr><th class=\"head\">scenario/pipeline/metric</th><th>trend</th>"
         "<th>first</th><th>now</th><th>nights</th></tr></thead><tbody>\n" +
         out + "</tbody></table></div>\n";
}

/// One word per pipeline and scenario: the worst that happened there.
std::string matrix(const Comparison& comparison) {
  std::vector<std::string> scenarios, pipelines;
  const auto add_name = [](std::vector<std::string>& names, const std::string& name) {
    if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  };
  for (const auto& change : comparison.changes) {
    add_name(scenarios, change.scenario);
    add_name(pipelines, change.pipeline);
  }
  for (const auto& broken : comparison.broken) {
    add_name(scenarios, broken.cell.scenario);
    add_name(pipelines, broken.cell.pipeline);
  }
  Table table{"matrix", "", "A number counts gates.", {"pipeline"}, {}, {}};
  for (const auto& scenario : scenarios) table.columns.push_back({"", scenario});
  for (const auto& pipeline : pipelines) {
    Table::Row row{{pipeline}, {}, false};
    for (const auto& scenario : scenarios) {
      std::size_t worse = 0, better = 0, same = 0, all = 0;
      for (const auto& change : comparison.changes) {
        if (!change.gate || change.scenario != scenario || change.pipeline != pipeline) continue;
        ++all;
        worse += change.finding == Finding::worse;
        better += change.finding == Finding::better;
        same += change.finding == Finding::same;
      }
      const auto broken = std::ranges::count_if(comparison.broken, [&](const StatusChange& change) {
        return change.cell.scenario == scenario && change.cell.pipeline == pipeline;
      });
      std::string text = all == 0 ? "–" : same == all ? "equal" : "within";
      if (better > 0) text = fmt::format("▲ {} better", better);
      if (worse > 0) text = fmt::format("▼ {} worse", worse);
      if (broken > 0) text = fmt::format("✗ {} broken", broken);
      row.cells.push_back({text, worse > 0 || broken > 0});
    }
    table.rows.push_back(std::move(row));
  }
  return table.rows.empty() ? "" : to_html(table);
}

std::string history(const NightInput& input) {
  constexpr std::size_t kShown = 30;
  Table table{"nights", "", "", {"start (UTC)", "commit", "verdict"}, {}, {}};
  for (std::size_t i = input.nights.size(); i-- > 0 && table.rows.size() < kShown;) {
    const Night& night = input.nights[i];
    table.rows.push_back({{night.start, night.commit.substr(0, 12), night.sentence}, {}, false});
  }
  return table.rows.size() < 2 ? "" : to_html(table);
}

std::string definitions(const NightInput& input) {
  const auto descriptions = metric_descriptions();
  std::set<std::string> used;
  if (input.comparison)
    for (const auto& change : input.comparison->changes) used.insert(change.metric.metric);
  std::string out;
  for (const auto& metric : used) {
    const auto found = descriptions.find(metric);
    if (found == descriptions.end()) continue;
    const std::string unit = found->second.unit.empty() ? "" : " [" + found->second.unit + "]";
    out += "<dt>" + escaped(metric + unit) + "</dt><dd>" + escaped(found->second.doc) + "</dd>\n";
  }
  return out.empty() ? "" : "<dl>\n" + out + "</dl>\n";
}

/// The table of that id. The page's own heading stands above it, unless it has `own_title`.
std::string table_of(const Comparison& comparison, const std::string& id, bool own_title = false) {
  for (auto& table : comparison_tables(comparison)) {
    if (table.id != id) continue;
    if (!own_title) table.title.clear();
    return to_html(table);
  }
  return "";
}

/// A part of the page: the id of its heading, the heading, and what is below it. Empty parts are left out.
struct Part {
  std::string id;
  std::string title;
  std::string body;
};

std::vector<Part> parts_of(const NightInput& input) {
  std::vector<Part> parts;
  const auto add = [&](const char* id, const char* title, std::string body) {
    if (!body.empty()) parts.push_back({id, title, std::move(body)});
  };
  if (const auto& comparison = input.comparison) {
    const std::string worse = table_of(*comparison, "worse");
    add("worse-section", "What became worse",
        (worse.empty() ? "<p>Nothing.</p>\n" : worse) + pictures(input) + table_of(*comparison, "uncertain", true));
    add("differs-section", "What differs", list_of(comparison->differing));
    add("better-section", "What became better", table_of(*comparison, "better"));
    add("cells-section", "Completeness", table_of(*comparison, "completeness"));
    add("matrix-section", "Pipelines × scenarios", matrix(*comparison));
  }
  if (!input.report.empty())
    add("report-section", "Rankings, tables and figures",
        fmt::format(
            "<p><a href=\"{}\">The report of this run</a> ranks the pipelines and shows every scenario with its "
            "figures.</p>\n",
            escaped(input.report)));
  add("trends-section", "Trends", trends(input));
  add("nights-section", "Nights", history(input));
  add("definitions-section", "What the metrics mean", definitions(input));
  return parts;
}

}  // namespace

std::string night_page(const NightInput& input) {
  std::string body;
  std::vector<std::pair<std::string, std::string>> links;
  for (const auto& [id, title, text] : parts_of(input)) {
    links.emplace_back(id, title);
    body += fmt::format("<h2 id=\"{}\">{}</h2>\n{}", id, title, text);
  }
  links.emplace_back("facts", "Provenance");
  return html_page("scanbench, night of " + input.suite,
                   verdict_banner(input) + contents(links) + body + html_facts(input.facts));
}

}  // namespace scanbench::harness
