// Makes the sentences, tables and charts of rankings of methods.
#include "harness/results/tables/ranking_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/names.hpp"
#include "harness/results/document/scatter_chart.hpp"
#include "harness/results/document/table.hpp"
#include "harness/results/tables/table_marks.hpp"

namespace scanbench::results {
namespace {

constexpr std::size_t kListedScenarios = 3;  // more are counted
const Display kMicroseconds{"µs", 1e6};      // of all times of a scan, so that they can be compared

/// The unit in which the values of a column are shown.
Display shown_unit(const std::string& unit, const std::vector<double>& values) {
  double largest = 0.0;
  for (const double v : values)
    if (std::isfinite(v)) largest = std::max(largest, std::fabs(v));
  return display_for(unit, largest);
}

Display quality_unit(const MethodRanking& ranking) {
  std::vector<double> values;
  for (const auto& method : ranking.methods) values.push_back(method.quality.mean);
  return shown_unit(ranking.quality.unit, values);
}

std::string interval_text(const MeanInterval& interval) {
  return std::isfinite(interval.mean) ? fmt::format("{:.2f} … {:.2f}", interval.low, interval.high) : "";
}

TableCell probability_cell(const MeanInterval& interval) {
  if (!std::isfinite(interval.mean)) return {"–"};
  return {.text = fmt::format("{:.2f}", interval.mean), .spread = interval_text(interval)};
}

TableCell quality_cell(const RankedMethod& method, const Display& display, bool is_best) {
  TableCell cell{.text = value_text(method.quality.mean, display), .best = is_best};
  if (method.quality.count > 1) cell.spread = spread_text(method.quality.half_width(), display);
  if (!method.complete()) cell.spread += fmt::format(" ({} of {})", method.defined, method.cells);
  return cell;
}

Table method_table(const MethodRanking& ranking) {
  const Display quality = quality_unit(ranking);
  Table table{"",
              "",
              "",
              {"pipeline"},
              {metric_column(ranking.quality, quality),
               {"", "beats the next"},
               {"", heading("time a scan", kMicroseconds), false, "", heading("time a scan", kMicroseconds) + " ↓"},
               {"", "front"}},
              {}};
  for (const auto& method : ranking.methods) {
    const bool is_best = &method == &ranking.methods.front() && method.complete();
    table.rows.push_back({{method.pipeline},
                          {quality_cell(method, quality, is_best),
                           probability_cell(method.beats_next),
                           {value_text(method.seconds, kMicroseconds)},
                           {method.on_front ? "●" : ""}},
                          false});
  }
  return table;
}

std::string list_of(const std::vector<std::string>& scenarios) {
  return scenarios.size() <= kListedScenarios ? join(scenarios) : fmt::format("{} scenarios", scenarios.size());
}

/// The scenarios as links, and their condition. Many scenarios are below the heading, folded.
Blocks heading_of(const MethodRanking& ranking, const std::string& report) {
  Prose links;
  for (const auto& name : ranking.scenarios) {
    if (!links.spans.empty()) links.spans.emplace_back(", ");
    links.spans.push_back(report.empty() ? TextSpan(name) : link(name, report + "#" + name));
  }
  const std::string& condition = ranking.condition;
  if (ranking.scenarios.size() > kListedScenarios)
    return {
        Heading{3, fmt::format("{} scenarios{}{}", ranking.scenarios.size(), condition.empty() ? "" : ": ", condition)},
        Fold{"which", {Paragraph{links}}}};
  Blocks blocks{Heading{3, links}};
  if (!condition.empty()) blocks.push_back(Paragraph{"Condition: " + condition, "faint"});
  return blocks;
}

}  // namespace

/// Of fewer seeds not even a pipeline that wins on each has a Clopper-Pearson interval above one half: the lower end is
/// 0.025^(1/n), 0.478 for 5 and 0.541 for 6.
constexpr int kFewestSeeds = 6;

std::string ranking_sentence(const MethodRanking& ranking) {
  const auto& methods = ranking.methods;
  const std::string where = list_of(ranking.scenarios);
  const auto complete = std::ranges::count_if(methods, &RankedMethod::complete);
  if (complete == 0) return fmt::format("No pipeline has values for all cells of {}, so none is called best.", where);
  const RankedMethod& best = methods.front();
  const Display display = quality_unit(ranking);
  const std::string unit = display.unit.empty() ? "" : " " + display.unit;
  std::string text =
      fmt::format("{} has the best {} of {} pipelines in {}, {}{}", best.pipeline, words_of(ranking.quality), complete,
                  where, value_text(best.quality.mean, display), unit);
  if (std::isfinite(best.beats_next.mean)) {
    const std::string& next = methods[1].pipeline;
    if (best.beats_next.low > 0.5)
      text += fmt::format(", and beats the next, {}, with probability {:.2f}", next, best.beats_next.mean);
    else if (best.beats_next.count < kFewestSeeds)
      text += fmt::format("; {} seeds are too few to tell whether it beats the next, {} (at least {})",
                          best.beats_next.count, next, kFewestSeeds);
    else
      text += fmt::format("; the seeds do not separate it from the next, {}", next);
  }
  text += ".";
  if (complete < std::ssize(methods))
    text += fmt::format(" {} more {} not complete.", std::ssize(methods) - complete,
                        std::ssize(methods) - complete == 1 ? "is" : "are");
  return text;
}

std::string budget_sentence(const MethodRanking& ranking) {
  std::vector<const RankedMethod*> front;
  for (const auto& method : ranking.methods)
    if (method.on_front) front.push_back(&method);
  if (front.size() < 2) return "";
  std::ranges::sort(front, {}, &RankedMethod::seconds);
  const Display quality = quality_unit(ranking);
  std::vector<std::string> parts;
  parts.reserve(front.size());
  for (const RankedMethod* method : front) {
    parts.push_back(fmt::format("{} from {} {} ({})", method->pipeline, value_text(method->seconds, kMicroseconds),
                                kMicroseconds.unit, value_text(method->quality.mean, quality)));
  }
  return "The best for a given time a scan: " + join(parts) + ".";
}

std::string accuracy_chart(const MethodRanking& ranking) {
  const Display quality = quality_unit(ranking);
  ScatterChart chart{"CPU time of one scan [µs]", heading(words_of(ranking.quality), quality), {}};
  for (const auto& method : ranking.methods)
    chart.points.push_back(
        {1e6 * method.seconds, quality.scale * method.quality.mean, method.pipeline, method.on_front});
  return scatter_chart(chart);
}

Blocks ranking_blocks(const std::vector<MethodRanking>& rankings, const std::string& report) {
  if (rankings.empty()) return {};
  Blocks blocks{Paragraph{
      "Means over the seeds with their 95 % intervals. “Beats the next” is the probability to be better than the next "
      "row on a new seed, with its 95 % interval. The time is the CPU time of all stages of one scan. ● no other "
      "pipeline is both as good and as fast.",
      "caption"}};
  for (const auto& ranking : rankings) {
    add_blocks(blocks, heading_of(ranking, report));
    blocks.push_back(Paragraph{ranking_sentence(ranking) + " " + budget_sentence(ranking)});
    blocks.push_back(BlockGroup{"ranking", {method_table(ranking), Markup{accuracy_chart(ranking)}}});
  }
  return blocks;
}

}  // namespace scanbench::results
