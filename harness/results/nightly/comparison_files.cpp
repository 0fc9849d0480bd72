// Writes a comparison as JSON and JUnit XML.
#include "harness/results/nightly/comparison_files.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "harness/io/files/json.hpp"
#include "harness/results/analysis/verdict.hpp"
#include "harness/results/document/plain_text.hpp"

namespace scanbench::results {
namespace {

using Json = nlohmann::ordered_json;

Json json_number(double value) {
  return std::isfinite(value) ? Json(value) : Json();  // JSON has no NaN
}

Json cell_json(const runs::CellKey& key) {
  return {{"scenario", key.scenario}, {"pipeline", key.pipeline}, {"seed", key.seed}};
}

Json cells_json(const std::vector<runs::CellKey>& cells) {
  Json list = Json::array();
  for (const auto& key : cells) list.push_back(cell_json(key));
  return list;
}

Json statuses_json(const std::vector<StatusChange>& changes) {
  Json list = Json::array();
  for (const auto& change : changes) {
    Json entry = cell_json(change.cell);
    entry["before"] = change.before;
    entry["after"] = change.after;
    entry["message"] = plain_line(change.message);
    list.push_back(std::move(entry));
  }
  return list;
}

Json change_json(const MetricChange& change) {
  Json pairs = Json::array();
  for (const auto& pair : change.pairs)
    pairs.push_back({{"seed", pair.seed}, {"before", json_number(pair.before)}, {"after", json_number(pair.after)}});
  Json scans;  // null unless the scans of a recorded log are paired
  if (change.scans)
    scans = {{"of", change.scans->of},
             {"count", change.scans->count},
             {"block", change.scans->block},
             {"undefined_now", change.scans->lost},
             {"undefined_before", change.scans->gained}};
  return {{"scenario", change.scenario},
          {"pipeline", change.pipeline},
          {"metric", change.metric.metric},
          {"unit", change.metric.unit},
          {"gate", change.gate},
          {"finding", to_string(change.finding)},
          {"before", json_number(change.before)},
          {"after", json_number(change.after)},
          {"difference", json_number(change.difference.mean)},
          {"ci_low", json_number(change.difference.low)},
          {"ci_high", json_number(change.difference.high)},
          {"tolerance", change.metric.tolerance},
          {"effect", json_number(change.effect)},
          {"p", json_number(change.p)},
          {"q", json_number(change.q)},
          {"undefined_now", change.lost},
          {"scans", std::move(scans)},
          {"by_value", change.by_value},
          {"pairs", std::move(pairs)}};
}

/// Text for XML: no characters that XML 1.0 forbids.
std::string xml(const std::string& text) {
  return html_escaped(plain_line(text));
}

std::string test_case(const std::string& group, const std::string& name, const std::string& outcome) {
  return fmt::format("  <testcase classname=\"{}\" name=\"{}\"{}\n", xml(group), xml(name),
                     outcome.empty() ? "/>" : ">" + outcome + "</testcase>");
}

}  // namespace

std::string comparison_json(const Comparison& comparison) {
  Json changes = Json::array();
  for (const auto& change : comparison.changes) changes.push_back(change_json(change));
  const Json json{{"schema", 1},
                  {"verdict", verdict_word(comparison)},
                  {"sentence", verdict_sentence(comparison)},
                  {"before", comparison.before},
                  {"after", comparison.after},
                  {"differing", comparison.differing},
                  {"cells_compared", comparison.cells},
                  {"gates", comparison.gates},
                  {"broken", statuses_json(comparison.broken)},
                  {"mended", statuses_json(comparison.mended)},
                  {"failing", statuses_json(comparison.failing)},
                  {"missing", cells_json(comparison.missing)},
                  {"absent_metrics", comparison.absent},
                  {"dropped_metrics", comparison.dropped},
                  {"added", cells_json(comparison.added)},
                  {"changes", std::move(changes)}};
  return io::json_text(json) + "\n";
}

std::string comparison_junit(const Comparison& comparison) {
  std::string cases;
  std::size_t tests = 0;
  std::size_t failures = 0;
  for (const auto& change : comparison.changes) {
    if (!change.gate) continue;
    ++tests;
    const bool worse = change.finding == Finding::worse;
    failures += worse ? 1 : 0;
    cases += test_case(change.scenario + "." + change.pipeline, change.metric.metric,
                       worse ? "<failure message=\"" + xml(change_sentence(change)) + "\"/>" : "");
  }
  for (const auto* cells : {&comparison.broken, &comparison.failing})
    for (const auto& failed : *cells) {
      ++tests;
      ++failures;
      cases += test_case(failed.cell.scenario + "." + failed.cell.pipeline, "seed " + std::to_string(failed.cell.seed),
                         fmt::format("<failure message=\"{}: {}\"/>", xml(failed.after), xml(failed.message)));
    }
  for (const auto& key : comparison.missing) {
    ++tests;
    cases += test_case(key.scenario + "." + key.pipeline, "seed " + std::to_string(key.seed),
                       "<error message=\"the cell is missing\"/>");
  }
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<testsuite name=\"scanbench\" tests=\"{}\" failures=\"{}\" errors=\"{}\">\n{}</testsuite>\n",
      tests, failures, comparison.missing.size(), cases);
}

}  // namespace scanbench::results
