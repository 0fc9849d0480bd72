// Pairs the cells of two runs by seed, takes differences, tests them and says what they mean.
#include "harness/results/analysis/comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>
#include <utility>

#include "core/special_values.hpp"
#include "harness/results/analysis/block_bootstrap.hpp"
#include "harness/results/analysis/cell_pair.hpp"
#include "harness/results/analysis/scan_pairs.hpp"

namespace scanbench::results {
namespace {

using metrics::Direction;
using metrics::MetricDescription;

constexpr double kFalseFindings = 0.05;
constexpr std::size_t kLeastTimes = 9;  // a rank test of fewer repeats finds next to nothing

/// The change of a value as a change of its cost: above 0 is worse.
double cost_change(const MetricDescription& metric, double before, double after) {
  return metrics::cost(metric, after) - metrics::cost(metric, before);
}

/// A change whose numbers are there, before it is tested.
class ChangeJudge {
 public:
  explicit ChangeJudge(bool same_processor) : same_processor_(same_processor) {}

  /// Means, interval and p-value, from the seeds.
  void measure(MetricChange& change) const {
    std::vector<double> before, after, differences, costs;
    for (const auto& pair : change.pairs) {
      if (std::isfinite(pair.before) && !std::isfinite(pair.after)) ++change.lost;
      if (!std::isfinite(pair.before) || !std::isfinite(pair.after)) continue;
      before.push_back(pair.before);
      after.push_back(pair.after);
      differences.push_back(pair.after - pair.before);
      costs.push_back(cost_change(change.metric, pair.before, pair.after));
    }
    change.before = mean_of(before);
    change.after = mean_of(after);
    change.difference = mean_interval(differences);
    change.worsening = mean_interval(costs);
    if (change.by_tolerance())
      for (MeanInterval* interval : {&change.difference, &change.worsening})
        interval->low = interval->high = interval->mean;
    change.effect = effect_size(differences, change.difference.mean);
    change.q = change.p = kNaN;
    if (change.metric.timing) {
      if (same_processor_ && differences.size() >= kLeastTimes) change.p = rank_p_value(before, after);
    } else if (!change.by_tolerance() && change.finding != Finding::same) {
      change.p = paired_p_value(costs);
    }
  }

  /// The interval and the p-value of a recorded log, from its scans.
  static void measure_scans(MetricChange& change, const ScanPairs& scans) {
    change.by_value = scans.obstacle;
    if (!scans.obstacle.empty()) return;
    const BlockInterval interval =
        block_interval(scans.pairs, scans.mean, [&](double value) { return metrics::cost(change.metric, value); });
    change.difference = interval.difference;
    change.worsening = interval.worsening;
    change.effect = interval.effect;
    change.p = interval.p;
    change.scans = scans.counts;
    change.scans->block = interval.block;
  }

  /// After q has been corrected for all gates.
  static void judge(MetricChange& change) {
    const MetricDescription& metric = change.metric;
    if (metric.timing && std::isnan(change.p)) {
      change.finding = Finding::not_compared;
      return;
    }
    if (change.finding == Finding::same) return;
    if (metric.direction == Direction::neither) {
      change.finding = Finding::changed;
      return;
    }
    if (change.lost > 0) {
      change.finding = Finding::worse;
      return;
    }
    if (change.difference.count == 0) {
      change.finding = gained(change) ? Finding::better : Finding::changed;
      return;
    }
    const double worsening = change.worsening.mean;
    if (std::fabs(worsening) <= metric.tolerance) {
      change.finding = Finding::within;
    } else if (!is_certain(change)) {
      change.finding = Finding::uncertain;
    } else {
      change.finding = worsening > 0 ? Finding::worse : Finding::better;
    }
  }

 private:
  static double mean_of(const std::vector<double>& values) {
    double sum = 0.0;
    for (const double v : values) sum += v;
    return values.empty() ? kNaN : sum / static_cast<double>(values.size());
  }

  static double effect_size(const std::vector<double>& differences, double mean) {
    if (differences.size() < 2) return kNaN;
    double squares = 0.0;
    for (const double d : differences) squares += (d - mean) * (d - mean);
    const double deviation = std::sqrt(squares / static_cast<double>(differences.size() - 1));
    return deviation > 0 ? mean / deviation : kNaN;
  }

  static bool gained(const MetricChange& change) {
    return std::ranges::any_of(
        change.pairs, [](const SeedPair& pair) { return !std::isfinite(pair.before) && std::isfinite(pair.after); });
  }

  static bool is_certain(const MetricChange& change) {
    if (change.by_tolerance()) return true;  // equal seeds: the difference comes from the code
    const bool excludes_zero = change.worsening.low > 0 || change.worsening.high < 0;
    return change.q <= kFalseFindings && (excludes_zero || change.metric.timing);
  }

  bool same_processor_;
};

/// Paths of files inside the run, which depend on how many scenarios it has, without the leading "../".
std::string without_parents(std::string value) {
  while (value.starts_with("../")) value.erase(0, 3);
  return value;
}

/// "abcdef: pipelines.iepf.extract.params.threshold_m: 0.1 -> 0.2". Scenarios with the same difference share an entry.
void compare_settings(const RunResults& a, const RunResults& b, std::vector<std::string>& differing) {
  constexpr std::size_t kShown = 12, kNamed = 3;
  std::vector<std::pair<std::string, std::vector<std::string>>> differences;  // difference, scenarios
  for (const auto& [scenario, settings] : b.settings) {
    const auto earlier = a.settings.find(scenario);
    if (earlier == a.settings.end()) continue;
    std::set<std::string> paths;
    for (const auto& [path, value] : settings) paths.insert(path);
    for (const auto& [path, value] : earlier->second) paths.insert(path);
    for (const auto& path : paths) {
      if (path == "about" || path.starts_with("figures")) continue;  // they change no value
      const auto value_in = [&path](const std::map<std::string, std::string>& run) {
        const auto found = run.find(path);
        return found == run.end() ? std::string("(absent)") : found->second;
      };
      const std::string before = value_in(earlier->second);
      const std::string after = value_in(settings);
      if (without_parents(before) == without_parents(after)) continue;
      const std::string difference = fmt::format("{}: {} -> {}", path, before, after);
      auto known = std::ranges::find(differences, difference, &decltype(differences)::value_type::first);
      if (known == differences.end()) known = differences.insert(known, {difference, {}});
      known->second.push_back(scenario);
    }
  }
  for (std::size_t i = 0; i < differences.size() && i < kShown; ++i) {
    const auto& [difference, scenarios] = differences[i];
    std::string where;
    for (std::size_t k = 0; k < scenarios.size() && k < kNamed; ++k) where += (k > 0 ? ", " : "") + scenarios[k];
    if (scenarios.size() > kNamed) where += fmt::format(" and {} more", scenarios.size() - kNamed);
    differing.push_back(where + ": " + difference);
  }
  if (differences.size() > kShown) differing.push_back(fmt::format("{} more settings", differences.size() - kShown));
}

/// Twelve digits of a commit and, for a tree with changes, six of the hash of its code.
std::string short_commit(const std::string& commit) {
  const auto changes = commit.find("-dirty-");
  if (changes == std::string::npos) return commit.substr(0, 12);
  return commit.substr(0, std::min<std::size_t>(changes, 12)) + commit.substr(changes, 13);
}

std::vector<std::string> what_differs(const RunResults& a, const RunResults& b,
                                      const std::vector<std::string>& recordings) {
  std::vector<std::string> differing;
  const auto add = [&](const char* what, const std::string& before, const std::string& after) {
    if (before != after && !before.empty() && !after.empty())
      differing.push_back(fmt::format("{}: {} -> {}", what, before, after));
  };
  add("commit", short_commit(a.provenance.commit), short_commit(b.provenance.commit));
  add("compiler", a.provenance.compiler, b.provenance.compiler);
  add("libraries", a.provenance.libraries, b.provenance.libraries);
  add("processor", a.provenance.processor, b.provenance.processor);
  compare_settings(a, b, differing);
  constexpr std::size_t kShown = 5;
  for (std::size_t i = 0; i < recordings.size() && i < kShown; ++i)
    differing.push_back("scans of " + recordings[i] + ": the recordings are not the same");
  if (recordings.size() > kShown)
    differing.push_back(fmt::format("scans of {} more recordings", recordings.size() - kShown));
  return differing;
}

class Comparer {
 public:
  Comparer(const RunResults& before, const RunResults& after, const Gates& gates)
      : before_(before),
        after_(after),
        gates_(gates),
        judge_(before.provenance.processor == after.provenance.processor && !after.provenance.processor.empty()) {}

  Comparison compare() {
    result_.before = before_.name;
    result_.after = after_.name;
    std::map<runs::CellKey, const CellResults*> earlier;
    for (const auto& cell : before_.cells) earlier.emplace(cell.key, &cell);
    for (const auto& cell : after_.cells) {
      const auto found = earlier.find(cell.key);
      compare_cells(found == earlier.end() ? nullptr : found->second, &cell);
      if (found != earlier.end()) earlier.erase(found);
    }
    for (const auto& cell : before_.cells)
      if (earlier.contains(cell.key)) compare_cells(&cell, nullptr);
    for (auto& [key, change] : changes_) result_.changes.push_back(std::move(change));
    judge_all();
    result_.absent.assign(absent_.begin(), absent_.end());
    result_.dropped.assign(dropped_.begin(), dropped_.end());
    result_.differing = what_differs(before_, after_, {differing_scans_.begin(), differing_scans_.end()});
    return std::move(result_);
  }

 private:
  static bool is_there(const CellResults* cell) { return cell != nullptr && cell->status != "missing"; }

  void compare_cells(const CellResults* a, const CellResults* b) {
    const runs::CellKey& key = b != nullptr ? b->key : a->key;
    const bool requested = (b != nullptr && b->requested) || (a != nullptr && a->requested);
    if (!is_there(b)) {
      if (b != nullptr && b->requested) result_.unfinished = true;
      // A cell that neither run asks for may be absent from both.
      if (requested || is_there(a)) result_.missing.push_back(key);
      return;
    }
    if (!is_there(a)) {
      result_.added.push_back(key);
      if (!b->ok()) result_.failing.push_back({key, "missing", b->status, b->message});
      return;
    }
    if (!a->recording.empty() && !b->recording.empty() && a->recording != b->recording)
      differing_scans_.insert(key.scenario + "/" + std::to_string(key.seed));
    if (a->ok() && b->ok()) {
      ++result_.cells;
      compare_rows(*a, *b);
    } else if (a->ok()) {
      result_.broken.push_back({key, a->status, b->status, b->message});
    } else if (b->ok()) {
      result_.mended.push_back({key, a->status, b->status, ""});
    } else {
      result_.failing.push_back({key, a->status, b->status, b->message});
    }
  }

  void compare_rows(const CellResults& a, const CellResults& b) {
    const auto rows_a = by_metric(a.rows);
    const auto rows_b = by_metric(b.rows);
    std::set<std::string> names;
    for (const auto& [metric, rows] : rows_a) names.insert(metric);
    const std::set<std::string> gates = gates_.among(names);
    for (const auto& [metric, rows] : rows_b) names.insert(metric);
    for (const auto& metric : names) {
      const auto in_a = rows_a.find(metric);
      const auto in_b = rows_b.find(metric);
      if (in_a == rows_a.end()) continue;  // a new metric has nothing to be compared with
      if (in_b == rows_b.end()) {
        if (gates.contains(metric))
          absent_.insert(b.key.scenario + "/" + b.key.pipeline + ": " + metric);
        else
          dropped_.insert(metric);
        continue;
      }
      const CellPair pair = pair_of(in_a->second, in_b->second);
      MetricChange& change = change_of(b.key, metric, gates.contains(metric));
      change.pairs.push_back({b.key.seed, pair.before, pair.after});
      if (pair.subjects.uncommon() > change.subjects.uncommon()) change.subjects = pair.subjects;
      if (!pair.same) change.finding = Finding::changed;
    }
  }

  MetricChange& change_of(const runs::CellKey& key, const std::string& metric, bool gate) {
    const auto [place, is_new] = changes_.try_emplace({key.scenario, key.pipeline, metric});
    if (is_new) {
      place->second.scenario = key.scenario;
      place->second.pipeline = key.pipeline;
      place->second.metric = gates_.description(metric);
      place->second.metric.metric = metric;
      place->second.gate = gate;
    }
    return place->second;
  }

  void measure_scans(MetricChange& change, ScanPairer& pairer) const {
    const std::uint64_t seed = change.pairs.front().seed;
    const bool same_scans = !differing_scans_.contains(change.scenario + "/" + std::to_string(seed));
    if (const auto scans = pairer.pairs_of({change.scenario, change.pipeline, seed}, change.metric.metric, same_scans))
      ChangeJudge::measure_scans(change, *scans);
  }

  void judge_all() {
    std::vector<double> p_values;
    ScanPairer pairer(before_, after_);
    for (auto& change : result_.changes) {
      judge_.measure(change);
      if (change.pairs.size() == 1 && change.difference.count == 1 && !change.metric.timing &&
          change.finding != Finding::same)
        measure_scans(change, pairer);
      result_.gates += change.gate ? 1U : 0U;
      p_values.push_back(change.gate ? change.p : kNaN);
    }
    const std::vector<double> q_values = benjamini_hochberg(p_values);
    for (std::size_t i = 0; i < q_values.size(); ++i) {
      MetricChange& change = result_.changes[i];
      change.q = change.gate ? q_values[i] : change.p;
      ChangeJudge::judge(change);
    }
  }

  const RunResults& before_;
  const RunResults& after_;
  const Gates& gates_;
  ChangeJudge judge_;
  std::map<std::tuple<std::string, std::string, std::string>, MetricChange> changes_;
  std::set<std::string> differing_scans_;
  std::set<std::string> absent_;
  std::set<std::string> dropped_;
  Comparison result_;
};

}  // namespace

std::string_view to_string(Finding finding) {
  static constexpr std::string_view kNames[] = {"same",  "within",  "uncertain",   "better",
                                                "worse", "changed", "not_compared"};
  return kNames[static_cast<std::size_t>(finding)];
}

const SeedPair* MetricChange::worst() const {
  const SeedPair* worst = nullptr;
  double most = -kInf;
  for (const auto& pair : pairs) {
    if (!std::isfinite(pair.before)) continue;
    const double by = std::isfinite(pair.after) ? cost_change(metric, pair.before, pair.after) : kInf;
    if (by > most) {
      most = by;
      worst = &pair;
    }
  }
  return worst;
}

std::size_t Comparison::count(Finding finding, bool gates_only) const {
  return static_cast<std::size_t>(std::ranges::count_if(
      changes, [&](const MetricChange& change) { return change.finding == finding && (change.gate || !gates_only); }));
}

bool Comparison::failed() const {
  return !broken.empty() || !failing.empty() || count(Finding::worse) > 0;
}

int Comparison::exit_code() const {
  if (compared_nothing()) return 2;
  return (failed() ? 1 : 0) + (incomplete() ? 4 : 0);
}

Comparison compare(const RunResults& before, const RunResults& after, const Gates& gates) {
  return Comparer(before, after, gates).compare();
}

}  // namespace scanbench::results
