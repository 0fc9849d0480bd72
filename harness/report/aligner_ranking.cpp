// Means over scenarios seed by seed, then intervals over the seeds.
#include "harness/report/aligner_ranking.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <tuple>

#include "core/special_values.hpp"
#include "harness/analysis/statistics.hpp"
#include "harness/report/table_marks.hpp"

namespace scanbench::harness {
namespace {

/// Values of subject "all" by metric, scenario, pipeline and seed.
class Results {
 public:
  explicit Results(const std::vector<SummaryRow>& rows) {
    for (const SummaryRow& row : rows)
      if (row.subject == "all") values_[{row.metric, row.scenario, row.pipeline, row.seed}] = row.value;
  }
  /// NaN if there is none.
  double of(const std::string& metric, const std::string& scenario, const std::string& pipeline,
            std::uint64_t seed) const {
    const auto found = values_.find({metric, scenario, pipeline, seed});
    return found == values_.end() ? kNaN : found->second;
  }

 private:
  std::map<std::tuple<std::string, std::string, std::string, std::uint64_t>, double> values_;
};

struct Contest {
  std::vector<std::string> scenarios;  ///< by start error
  std::vector<double> start_m;
  std::vector<std::string> pipelines;
  std::vector<std::uint64_t> seeds;
};

std::vector<std::uint64_t> common_seeds(const std::vector<const Scenario*>& scenarios,
                                        const std::vector<std::string>& pipelines, const Results& results) {
  std::vector<std::uint64_t> seeds = scenarios.front()->seeds;
  std::erase_if(seeds, [&](std::uint64_t seed) {
    for (const Scenario* scenario : scenarios)
      for (const std::string& pipeline : pipelines)
        if (std::isnan(results.of("placed", scenario->name, pipeline, seed))) return true;
    return false;
  });
  return seeds;
}

Contest contest_of(const std::vector<Scenario>& all, const std::vector<SummaryRow>& rows, const Results& results) {
  std::set<std::string> reporting, running;
  for (const SummaryRow& row : rows)
    if (row.metric == "placed") {
      reporting.insert(row.scenario);
      running.insert(row.pipeline);
    }
  std::vector<const Scenario*> scenarios;
  for (const Scenario& scenario : all)
    if (reporting.contains(scenario.name)) scenarios.push_back(&scenario);
  if (scenarios.size() < 2) return {};
  Contest contest;
  for (const PipelineSpec& pipeline : scenarios.front()->pipelines)
    if (running.contains(pipeline.name)) contest.pipelines.push_back(pipeline.name);
  contest.seeds = common_seeds(scenarios, contest.pipelines, results);
  if (contest.seeds.empty()) return {};
  std::vector<std::pair<double, std::string>> starts;
  for (const Scenario* scenario : scenarios) {
    double sum = 0.0;
    for (const std::uint64_t seed : contest.seeds)
      sum += results.of("start_position_error", scenario->name, contest.pipelines.front(), seed);
    starts.emplace_back(sum / static_cast<double>(contest.seeds.size()), scenario->name);
  }
  std::ranges::stable_sort(starts, {}, &std::pair<double, std::string>::first);
  for (const auto& [start, name] : starts) {
    contest.start_m.push_back(start);
    contest.scenarios.push_back(name);
  }
  return contest;
}

/// Mean over the scenarios of `value`, for each seed.
template <class Value>
std::vector<double> by_seed(const Contest& contest, const Value& value) {
  std::vector<double> means;
  for (const std::uint64_t seed : contest.seeds) {
    double sum = 0.0;
    for (const std::string& scenario : contest.scenarios) sum += value(scenario, seed);
    means.push_back(sum / static_cast<double>(contest.scenarios.size()));
  }
  return means;
}

struct Ranked {
  std::string pipeline;
  std::vector<double> placed;      ///< for each seed
  std::vector<double> all_placed;  ///< for each seed
  std::vector<double> log_ratio;   ///< of the error to the start error, for each seed
};

std::string percent(const MeanInterval& share) {
  std::string text = fmt::format("{:.1f}", 100.0 * share.mean);
  if (share.count > 1) text += fmt::format(" ± {:.1f}", 100.0 * share.half_width());
  return text;
}

Table ranking(const std::vector<Ranked>& ranked, const Contest& contest) {
  Table table{"aligners",
              "Aligners, ranked by the share of scans that they place",
              fmt::format("Means over {} scenarios and {} seeds; intervals (95 %) over the seeds. Ratio of the mean "
                          "position error to that of the given poses: geometric mean. * the best value.",
                          contest.scenarios.size(), contest.seeds.size()),
              {"", "aligner"},
              {{"", "scans placed [%]", false},
               {"", "placed − next [points]", false},
               {"", "runs with all placed [%]", false},
               {"", "error / start error", false}},
              {}};
  for (std::size_t k = 0; k < ranked.size(); ++k) {
    const Ranked& one = ranked[k];
    TableCell next{"–"};
    if (k + 1 < ranked.size()) {
      std::vector<double> difference;
      for (std::size_t s = 0; s < one.placed.size(); ++s)
        difference.push_back(100.0 * (one.placed[s] - ranked[k + 1].placed[s]));
      const MeanInterval interval = mean_interval(difference);
      next.text = fmt::format("{:.1f}", interval.mean);
      if (interval.count > 1) next.text += fmt::format(" ({:.1f} to {:.1f})", interval.low, interval.high);
    }
    const MeanInterval ratio = mean_interval(one.log_ratio);
    std::string ratio_text = value_text(std::exp(ratio.mean), {});
    if (ratio.count > 1)
      ratio_text +=
          fmt::format(" ({} to {})", value_text(std::exp(ratio.low), {}), value_text(std::exp(ratio.high), {}));
    table.rows.push_back(
        {{std::to_string(k + 1), one.pipeline},
         {{percent(mean_interval(one.placed))}, next, {percent(mean_interval(one.all_placed))}, {ratio_text}},
         false});
  }
  const auto mark = [&](std::size_t column, const auto& value, metrics::Direction direction) {
    std::vector<TableCell*> cells;
    std::vector<double> means;
    for (std::size_t k = 0; k < ranked.size(); ++k) {
      cells.push_back(&table.rows[k].cells[column]);
      means.push_back(mean_interval(value(ranked[k])).mean);
    }
    mark_best(cells, means, {.metric = "", .unit = "", .direction = direction, .doc = ""});
  };
  mark(
      0, [](const Ranked& r) { return r.placed; }, metrics::Direction::higher_is_better);
  mark(
      2, [](const Ranked& r) { return r.all_placed; }, metrics::Direction::higher_is_better);
  mark(
      3, [](const Ranked& r) { return r.log_ratio; }, metrics::Direction::lower_is_better);
  return table;
}

Table basin(const std::vector<Ranked>& ranked, const Contest& contest, const Results& results) {
  Table table{"basin",
              "Runs with all scans placed [%], by the error of the given poses",
              fmt::format("Each of {} seeds. * the best of a row.", contest.seeds.size()),
              {"scenario", "start error [cm]"},
              {},
              {}};
  for (const Ranked& one : ranked) table.columns.push_back({"", one.pipeline, false});
  for (std::size_t s = 0; s < contest.scenarios.size(); ++s) {
    Table::Row row{{contest.scenarios[s], fmt::format("{:.1f}", 100.0 * contest.start_m[s])}, {}, false};
    std::vector<double> shares;
    for (const Ranked& one : ranked) {
      double sum = 0.0;
      for (const std::uint64_t seed : contest.seeds)
        sum += results.of("all_placed", contest.scenarios[s], one.pipeline, seed);
      shares.push_back(sum / static_cast<double>(contest.seeds.size()));
      row.cells.push_back({fmt::format("{:.0f}", 100.0 * shares.back())});
    }
    table.rows.push_back(std::move(row));
    std::vector<TableCell*> cells;
    for (TableCell& cell : table.rows.back().cells) cells.push_back(&cell);
    mark_best(cells, shares, {.metric = "", .unit = "", .direction = metrics::Direction::higher_is_better, .doc = ""});
  }
  return table;
}

}  // namespace

std::vector<Table> aligner_ranking(const std::vector<Scenario>& scenarios, const std::vector<SummaryRow>& rows) {
  const Results results(rows);
  const Contest contest = contest_of(scenarios, rows, results);
  if (contest.seeds.empty() || contest.pipelines.size() < 2) return {};
  std::vector<Ranked> ranked;
  for (const std::string& pipeline : contest.pipelines) {
    const auto values = [&](const char* metric) {
      return by_seed(contest, [&](const std::string& scenario, std::uint64_t seed) {
        return results.of(metric, scenario, pipeline, seed);
      });
    };
    const auto log_ratio = by_seed(contest, [&](const std::string& scenario, std::uint64_t seed) {
      return std::log(results.of("error_ratio", scenario, pipeline, seed));
    });
    ranked.push_back({pipeline, values("placed"), values("all_placed"), log_ratio});
  }
  std::ranges::stable_sort(ranked, std::ranges::greater{},
                           [](const Ranked& r) { return mean_interval(r.placed).mean; });
  return {ranking(ranked, contest), basin(ranked, contest, results)};
}

}  // namespace scanbench::harness
