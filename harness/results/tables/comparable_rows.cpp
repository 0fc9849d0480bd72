// Selects the seeds and lines that all pipelines have in common, and notes what is missing.
#include "harness/results/tables/comparable_rows.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>
#include <string_view>
#include <tuple>
#include <unordered_set>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "harness/results/analysis/gates.hpp"

namespace scanbench::results {
namespace {

constexpr const char* kOk = "ok";
constexpr const char* kMean = "mean";

/// The cells of the scenario. Without a list of cells, those with rows are ok and the others are missing.
std::vector<CellLine> cells_of(const study::Scenario& scenario, const std::vector<runs::SummaryRow>& rows,
                               const std::vector<CellLine>& cells) {
  std::vector<CellLine> own;
  for (const auto& cell : cells)
    if (cell.scenario == scenario.name) own.push_back(cell);
  if (!own.empty()) return own;
  std::set<std::pair<std::string, std::uint64_t>> present;
  std::set<std::uint64_t> seeds(scenario.seeds.begin(), scenario.seeds.end());
  for (const auto& row : rows) {
    if (row.scenario != scenario.name) continue;
    present.emplace(row.pipeline, row.seed);
    seeds.insert(row.seed);
  }
  for (const auto& pipeline : scenario.pipelines)
    for (const std::uint64_t seed : seeds)
      own.push_back({scenario.name, pipeline.name, seed, present.contains({pipeline.name, seed}) ? kOk : "missing", "",
                     0.0, 0.0});
  return own;
}

bool unconverged(const CellLine& cell) {
  return cell.message.find("align: ") != std::string::npos;
}

/// The number of scans with a status, in the remark on a slot: "match: 24 max_iterations, 57 degenerate; map: ...".
std::size_t scans_with(const std::string& status, std::string_view slot, const std::string& remarks) {
  const std::size_t begin = remarks.find(slot);
  if (begin == std::string::npos) return 0;
  std::istringstream outcomes(remarks.substr(begin + slot.size()));
  std::size_t count = 0;
  for (std::string word = ","; word.ends_with(',') && outcomes >> count >> word;)
    if (word.starts_with(status)) return count;
  return 0;
}

std::size_t scans_with(const std::string& status, const CellLine& cell) {
  return scans_with(status, "match: ", cell.message) + scans_with(status, "map: ", cell.message);
}

std::string scans_text(std::size_t count) {
  return fmt::format("{} scan{}", count, count == 1 ? "" : "s");
}

/// For each pipeline with a cell that is ok, the seeds of these cells.
std::map<std::string, std::set<std::uint64_t>> finished_seeds(const std::vector<CellLine>& cells) {
  std::map<std::string, std::set<std::uint64_t>> finished;
  for (const auto& cell : cells)
    if (cell.status == kOk) finished[cell.pipeline].insert(cell.seed);
  return finished;
}

/// The seeds that all of them have, in the order of `all`.
std::vector<std::uint64_t> common_seeds(const std::map<std::string, std::set<std::uint64_t>>& finished,
                                        const std::vector<std::uint64_t>& all) {
  std::vector<std::uint64_t> common;
  for (const std::uint64_t seed : all)
    if (std::ranges::all_of(finished, [&](const auto& of_pipeline) { return of_pipeline.second.contains(seed); }))
      common.push_back(seed);
  return common;
}

/// Replaces rows "mean" by means over the lines on which every pipeline has a value; the notes say which are left out.
void average_over_common_lines(ComparableRows& results) {
  using Key = std::tuple<std::string, std::uint64_t, std::string>;  // metric, seed, line
  std::map<Key, std::size_t> defined;
  std::map<std::pair<std::string, std::uint64_t>, std::set<std::string>> pipelines;
  std::map<std::pair<std::string, std::uint64_t>, std::set<std::string>> lines;
  for (const auto& row : results.rows) {
    if (row.subject == "all" || row.subject == kMean) continue;
    lines[{row.metric, row.seed}].insert(row.subject);
    if (!std::isfinite(row.value)) continue;
    pipelines[{row.metric, row.seed}].insert(row.pipeline);
    ++defined[{row.metric, row.seed, row.subject}];
  }
  const auto common = [&](const std::string& metric, std::uint64_t seed, const std::string& line) {
    const auto found = defined.find({metric, seed, line});
    return found != defined.end() && found->second == pipelines[{metric, seed}].size();
  };
  std::map<std::tuple<std::string, std::uint64_t, std::string>, std::pair<double, std::int64_t>> sums;
  for (const auto& row : results.rows) {
    if (row.subject == "all" || row.subject == kMean || !common(row.metric, row.seed, row.subject)) continue;
    auto& [sum, count] = sums[{row.metric, row.seed, row.pipeline}];
    sum += row.value;
    ++count;
  }
  std::map<std::string, std::set<std::string>> left_out;  // lines, by metrics
  for (auto& row : results.rows) {
    if (row.subject != kMean) continue;
    const auto& all = lines[{row.metric, row.seed}];
    std::set<std::string> missing;
    for (const auto& line : all)
      if (!common(row.metric, row.seed, line)) missing.insert(line);
    const auto found = sums.find({row.metric, row.seed, row.pipeline});
    if (missing.empty() || found == sums.end()) continue;
    row.value = found->second.first / static_cast<double>(found->second.second);
    row.count = found->second.second;
    left_out[row.metric].insert(missing.begin(), missing.end());
  }
  std::map<std::set<std::string>, std::vector<std::string>> metrics_of;
  for (const auto& [metric, missing] : left_out) metrics_of[missing].push_back(metric);
  if (metrics_of.empty()) return;
  const auto descriptions = metric_descriptions();
  for (const auto& [missing, metrics] : metrics_of) {
    std::vector<std::string> labels;
    for (const std::string& metric : metrics) {
      const auto known = descriptions.find(metric);
      labels.push_back(known == descriptions.end() ? metric : known->second.label);
    }
    results.line_notes.push_back(
        {metrics, fmt::format("mean of {}: over the lines on which every pipeline has a value, without {}",
                              fmt::join(labels, ", "), fmt::join(missing, ", "))});
  }
}

}  // namespace

std::string Coverage::status() const {
  const auto most = std::ranges::max_element(others, {}, [](const auto& entry) { return entry.second; });
  return most == others.end() ? "" : most->first;
}

std::string Coverage::text() const {
  std::vector<std::string> parts;
  if (!complete()) {
    std::vector<std::string> ends;
    for (const auto& [word, count] : others) ends.push_back(fmt::format("{} {}", count, word));
    parts.push_back(fmt::format("{} of {} ok, {}", ok, all, fmt::join(ends, ", ")));
  }
  if (unconverged > 0)
    parts.push_back(all == 1 ? std::string("not converged")
                             : fmt::format("not converged in {} of {} cells", unconverged, all));
  if (no_match_scans > 0) parts.push_back("no match on " + scans_text(no_match_scans));
  if (unconverged_scans > 0) parts.push_back("not converged on " + scans_text(unconverged_scans));
  return fmt::format("{}", fmt::join(parts, "; "));
}

ComparableRows comparable_rows(const study::Scenario& scenario, const std::vector<runs::SummaryRow>& rows,
                               const std::vector<CellLine>& all_cells) {
  ComparableRows results;
  std::vector<CellLine> cells = cells_of(scenario, rows, all_cells);
  std::erase_if(cells, [](const CellLine& cell) { return !cell.selected; });
  std::vector<std::uint64_t> seeds;
  std::unordered_set<std::uint64_t> seen;
  for (const auto& cell : cells) {
    Coverage& coverage = results.coverage[cell.pipeline];
    ++coverage.all;
    if (cell.status != kOk) {
      ++coverage.others[cell.status];
    } else {
      ++coverage.ok;
      coverage.unconverged += unconverged(cell) ? 1 : 0;
      coverage.no_match_scans += scans_with("no_match", cell);
      coverage.unconverged_scans += scans_with("max_iterations", cell);
    }
    if (seen.insert(cell.seed).second) seeds.push_back(cell.seed);
  }
  for (const auto& pipeline : scenario.pipelines)
    if (results.coverage.contains(pipeline.name)) results.pipelines.push_back(pipeline.name);
  const auto finished = finished_seeds(cells);
  results.seeds = common_seeds(finished, seeds);
  if (results.seeds.size() < seeds.size() && !finished.empty()) {
    if (results.seeds.empty()) {
      results.seeds = seeds;
      results.notes.emplace_back(
          "no seed was finished by all pipelines, so each mean is over the seeds that its pipeline finished");
    } else {
      results.notes.push_back(
          fmt::format("means are over the {} of {} seeds that every pipeline with a result finished",
                      results.seeds.size(), seeds.size()));
    }
  }
  const std::unordered_set<std::uint64_t> shown(results.seeds.begin(), results.seeds.end());
  for (const auto& row : rows)
    if (row.scenario == scenario.name && std::ranges::count(results.pipelines, row.pipeline) > 0 &&
        shown.contains(row.seed))
      results.rows.push_back(row);
  average_over_common_lines(results);
  return results;
}

study::Scenario restricted(study::Scenario scenario, const ComparableRows& results) {
  std::erase_if(scenario.pipelines,
                [&](const study::PipelineSpec& p) { return std::ranges::count(results.pipelines, p.name) == 0; });
  scenario.seeds = results.seeds;
  return scenario;
}

}  // namespace scanbench::results
