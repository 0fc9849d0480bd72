// Writes the page of a night.
#include "harness/nightly/night_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "harness/analysis/gates.hpp"
#include "harness/analysis/verdict.hpp"
#include "harness/files/base64.hpp"
#include "harness/nightly/comparison_tables.hpp"
#include "harness/nightly/status_matrix.hpp"
#include "harness/page/html_page.hpp"
#include "harness/page/plain_text.hpp"
#include "harness/page/scan_sketch.hpp"
#include "harness/page/sparkline.hpp"
#include "harness/page/table.hpp"
#include "harness/report/page_parts.hpp"
#include "harness/report/ranking_parts.hpp"

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
  if (input.comparison && !input.comparison->differing.empty()) {
    const auto& differing = input.comparison->differing;
    constexpr std::size_t kNamed = 3;
    out += "<p>What differs: ";
    for (std::size_t i = 0; i < differing.size() && i < kNamed; ++i) out += (i > 0 ? "; " : "") + escaped(differing[i]);
    if (differing.size() > kNamed)
      out += fmt::format("; <a href=\"#differs-section\">and {} more</a>", differing.size() - kNamed);
    out += "</p>\n";
  }
  return out + fmt::format("<p class=\"faint\">{}</p>\n", reuse_text(input.now.cells.size(), input.reused));
}

std::string list_of(const std::vector<std::string>& items) {
  if (items.empty()) return "";
  std::string out = "<ul>\n";
  for (const auto& item : items) out += "<li>" + escaped(item) + "</li>\n";
  return out + "</ul>\n";
}

std::string picture(const std::optional<PagePicture>& scan) {
  if (!scan) return "";
  return fmt::format(
      "<figure><img alt=\"{0}\" src=\"data:image/png;base64,{1}\"><figcaption>{0}</figcaption></figure>\n",
      escaped(scan->caption), base64(scan->png));
}

std::string picture_pairs(const std::vector<PicturePair>& pairs) {
  std::string out;
  for (const auto& pair : pairs)
    out += "<h3>" + escaped(pair.title) + "</h3>\n<div class=\"pair\">\n" + picture(pair.before) + picture(pair.now) +
           "</div>\n";
  return out;
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
std::string trends(const NightInput& input) {
  const auto descriptions = metric_descriptions();
  std::string out;
  for (const auto& [name, points] : input.trends) {
    if (points.size() < 2) continue;
    std::vector<double> values;
    for (const auto& point : points) values.push_back(point.value);
    const auto [low, high] = std::ranges::minmax(values);
    const auto known = descriptions.find(name.substr(name.rfind('/') + 1));
    const metrics::MetricDescription metric =
        known == descriptions.end() ? metrics::MetricDescription{} : known->second;
    out += fmt::format(
        "<tr><th class=\"head\">{}</th><td>{}</td><td>{}</td><td>{:.4g} … {:.4g}</td><td>{:.4g}</td><td>{:.4g}</td>"
        "<td>{}</td><td>{} since {}</td></tr>\n",
        escaped(name), better_text(metric), sparkline(values, name + " over the last nights"), low, high,
        values.front(), values.back(), escaped(metric.unit), points.size(),
        escaped(points.front().start.substr(0, 10)));
  }
  if (out.empty()) return "";
  return "<div class=\"scroll\"><table><thead><tr><th class=\"head\">scenario/pipeline/metric</th><th>better</th>"
         "<th>trend</th><th>from low to high</th><th>first</th><th>now</th><th>unit</th><th>nights</th></tr></thead>"
         "<tbody>\n" +
         out + "</tbody></table></div>\n";
}

/// Twelve digits; "(changed)" for a program whose code was not that of the commit.
std::string commit_text(const std::string& commit) {
  return commit.substr(0, 12) + (commit.find("-dirty-") == std::string::npos ? "" : " (changed)");
}

std::string history(const NightInput& input) {
  constexpr std::size_t kShown = 30;
  Table table{"nights", "", "", {"start (UTC)", "commit", "verdict"}, {}, {}};
  for (std::size_t i = input.nights.size(); i-- > 0 && table.rows.size() < kShown;) {
    const Night& night = input.nights[i];
    table.rows.push_back({{night.start, commit_text(night.commit), night.sentence}, {}, false});
  }
  return table.rows.size() < 2 ? "" : "<div class=\"nights\">\n" + to_html(table) + "</div>\n";
}

std::string definitions(const NightInput& input) {
  std::set<std::string> used;
  if (input.comparison)
    for (const auto& change : input.comparison->changes) used.insert(change.metric.metric);
  for (const auto& ranking : input.rankings) used.insert(ranking.quality.metric);
  return html_definitions(used);
}

/// The worst scans of each pipeline, each with the command that draws it large.
std::string worst_list(const NightInput& input) {
  if (input.worst.empty()) return "";
  std::string out =
      "<p>Lowest F1 over all scenarios and seeds first. The pointer on a name shows the command that draws the scan "
      "large.</p>\n" +
      scan_sketch_key();
  for (const auto& [pipeline, scans] : input.worst) {
    out += "<h3>" + escaped(pipeline) + "</h3>\n<div class=\"scans\">\n";
    for (const auto& scan : scans) {
      const std::string command =
          fmt::format("scanbench show {} --scenario {} --pipeline {} --seed {} --frame {}", shell_word(input.now.name),
                      scan.key.scenario, scan.key.pipeline, scan.key.seed, scan.frame);
      out += fmt::format(
          "<figure>{}<figcaption><a href=\"cells/{}/\" title=\"{}\">{}, seed {}, scan {}</a>: F1 {:.2f}, {} right, "
          "{} false, {} missed, {} split{}</figcaption></figure>\n",
          scan.sketch, escaped(to_string(scan.key)), escaped(command), escaped(scan.key.scenario), scan.key.seed,
          scan.frame, scan.f1, scan.found, scan.false_lines, scan.missed, scan.split,
          scan.unjudged > 0 ? fmt::format(", {} too short to judge", scan.unjudged) : "");
    }
    out += "</div>\n";
  }
  return out;
}

std::string file_list(const NightInput& input) {
  std::string out;
  if (!input.report.empty())
    out +=
        fmt::format("<li><a href=\"{}\">The report of this run</a>: every scenario with its tables and figures</li>\n",
                    escaped(input.report));
  for (const auto& file : input.files) out += fmt::format("<li><a href=\"{0}\">{0}</a></li>\n", escaped(file));
  return out.empty() ? "" : "<p>Beside this page in the run folder:</p>\n<ul>\n" + out + "</ul>\n";
}

/// The table of that id. The page's own heading stands above it, unless it has `own_title`.
std::string changes_of(const Comparison& comparison, const std::string& id, bool own_title = false) {
  for (auto& table : comparison_tables(comparison)) {
    if (table.id != id) continue;
    if (!own_title) table.title.clear();
    return "<div class=\"changes\">\n" + to_html(table) + "</div>\n";
  }
  return "";
}

std::string completeness_of(const Comparison& comparison) {
  auto table = completeness_table(comparison);
  if (!table) return "";
  table->title.clear();
  return to_html(*table);
}

std::vector<PagePart> parts_of(const NightInput& input) {
  std::vector<PagePart> parts;
  const auto add = [&](const char* id, const char* title, std::string body) {
    parts.push_back({id, title, std::move(body)});
  };
  if (const auto& comparison = input.comparison) {
    const std::string worse = changes_of(*comparison, "worse");
    add("worse-section", "What became worse",
        (worse.empty() ? "<p>Nothing.</p>\n" : worse) + picture_pairs(input.pictures) +
            changes_of(*comparison, "uncertain", true));
    add("differs-section", "What differs", list_of(comparison->differing));
    add("better-section", "What became better", changes_of(*comparison, "better"));
    add("cells-section", "Completeness", completeness_of(*comparison));
    add("matrix-section", "Pipelines × scenarios",
        html_status_matrices(input.now, *comparison, input.rankings, input.scenarios_page));
    add("figures-section", "Figures of what became worse", picture_pairs(input.figures));
  }
  add("rankings-section", "Rankings, and accuracy against time", html_rankings(input.rankings, input.scenarios_page));
  add("worst-section", "The worst scans of each pipeline", worst_list(input));
  add("trends-section", "Trends", trends(input));
  add("nights-section", "Nights", history(input));
  add("files-section", "Files", file_list(input));
  add("definitions-section", "What the metrics mean", definitions(input));
  return parts;
}

}  // namespace

std::string reuse_text(std::size_t cells, std::size_t reused) {
  if (reused == 0) return fmt::format("{} cells, all run in this night.", cells);
  return fmt::format("{} of {} cells were not run again, because nothing in them changed.", reused, cells);
}

std::string night_page(const NightInput& input) {
  return html_page("scanbench, night of " + input.suite,
                   verdict_banner(input) + html_parts(parts_of(input), input.facts));
}

}  // namespace scanbench::harness
