// Pairs the cells of two runs, takes differences and judges them.
#include "harness/analysis/compare.hpp"

#include <cmath>
#include <limits>
#include <optional>
#include <set>

#include "core/error.hpp"
#include "core/registry.hpp"
#include "harness/analysis/selection.hpp"
#include "harness/files/csv.hpp"
#include "harness/store/cell_files.hpp"
#include "harness/store/cell_status.hpp"
#include "harness/store/manifest.hpp"
#include "harness/store/recording_folder.hpp"

namespace scanbench::harness {
namespace fs = std::filesystem;
namespace {

using metrics::Direction;
using metrics::MetricDescription;
using metrics::MetricRow;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

std::map<std::string, MetricDescription> descriptions(const std::map<std::string, double>& tolerances) {
  std::map<std::string, MetricDescription> all;
  for (const auto& [name, entry] : Registry<metrics::MetricFamily>::all())
    for (auto& description : entry.make({})->describe()) all.emplace(description.metric, description);
  for (const auto& [metric, tolerance] : tolerances) {
    if (!(tolerance >= 0)) throw ConfigError("the tolerance of " + metric + " is negative; allowed: >= 0");
    all[metric].tolerance = tolerance;
  }
  return all;
}

/// A cell of one run: nothing if its folder is missing or damaged.
struct LoadedCell {
  CellStatus status = CellStatus::ok;
  std::vector<MetricRow> rows;
};

std::optional<LoadedCell> load_cell(const fs::path& run, const CellKey& key) {
  const fs::path folder = cell_path(run, key);
  if (!fs::exists(folder / "status.json")) return std::nullopt;
  LoadedCell cell{load_status(folder).outcome.status, {}};
  if (cell.status == CellStatus::ok) cell.rows = load_metrics(folder);
  return cell;
}

std::string status_of(const std::optional<LoadedCell>& cell) {
  return cell ? std::string(to_string(cell->status)) : "missing";
}

/// Different bits count as a change, so that the smallest drift is visible. An infinite value is no result: in either
/// direction it is not better than any other.
Verdict judge(const MetricDescription& description, double a, double b) {
  if (description.timing) return Verdict::timing;
  if (a == b || (std::isnan(a) && std::isnan(b))) return Verdict::same;
  if (!std::isfinite(a) && !std::isfinite(b)) return Verdict::changed;
  if (!std::isfinite(b)) return Verdict::worse;
  if (!std::isfinite(a)) return Verdict::better;
  const double change = b - a;
  if (std::fabs(change) <= description.tolerance) return Verdict::within;
  if (description.direction == Direction::neither) return Verdict::changed;
  if (metrics::better(description, b, a)) return Verdict::better;
  return metrics::better(description, a, b) ? Verdict::worse : Verdict::changed;
}

class Comparer {
 public:
  Comparer(const fs::path& a, const fs::path& b, const std::map<std::string, double>& tolerances)
      : a_(a), b_(b), descriptions_(descriptions(tolerances)) {}

  Comparison compare() {
    const Manifest a = load_manifest(a_);
    const Manifest b = load_manifest(b_);
    const std::set<CellKey> in_a(a.cells.begin(), a.cells.end());
    const std::set<CellKey> in_b(b.cells.begin(), b.cells.end());
    const auto not_requested = [](const Manifest& run, const std::set<CellKey>& cells, const CellKey& key) {
      return !cells.contains(key) || !was_selected(run, key);
    };
    const auto compare_unless_left_out = [&](const CellKey& key) {
      compare_cell(key, not_requested(a, in_a, key) && not_requested(b, in_b, key));
    };
    for (const auto& key : a.cells) compare_unless_left_out(key);
    for (const auto& key : b.cells)
      if (!in_a.contains(key)) compare_unless_left_out(key);
    for (const auto& row : result_.rows) ++result_.counts[row.verdict];
    return std::move(result_);
  }

 private:
  /// `left_out` means that neither run requested the cell, so it may be missing in both.
  void compare_cell(const CellKey& key, bool left_out) {
    const auto a = load_cell(a_, key);
    const auto b = load_cell(b_, key);
    if (left_out && !a && !b) return;
    compare_recordings(key);
    const bool a_ok = a && a->status == CellStatus::ok;
    const bool b_ok = b && b->status == CellStatus::ok;
    if (!a || !b) result_.incomplete = true;
    if (!a_ok || !b_ok) {
      ComparisonRow row;
      row.cell = key;
      row.metric = "status";
      row.a = row.b = row.difference = kNan;
      row.note = status_of(a) + " -> " + status_of(b);
      row.verdict = !b     ? Verdict::only_in_a
                    : !a   ? Verdict::only_in_b
                    : a_ok ? Verdict::worse
                    : b_ok ? Verdict::better
                           : Verdict::not_judged;
      result_.rows.push_back(row);
      return;
    }
    compare_rows(key, a->rows, b->rows);
  }

  void compare_rows(const CellKey& key, const std::vector<MetricRow>& a, const std::vector<MetricRow>& b) {
    std::map<std::pair<std::string, std::string>, const MetricRow*> rows_b;
    for (const auto& row : b) rows_b.emplace(std::pair{row.metric, row.subject}, &row);
    for (const auto& row : a) {
      const auto found = rows_b.find({row.metric, row.subject});
      if (found == rows_b.end()) {
        add(key, row, row.value, kNan, Verdict::only_in_a);
        continue;
      }
      add(key, row, row.value, found->second->value,
          judge(description_of(row.metric), row.value, found->second->value));
      rows_b.erase(found);
    }
    for (const auto& row : b)
      if (rows_b.contains({row.metric, row.subject})) add(key, row, kNan, row.value, Verdict::only_in_b);
  }

  MetricDescription description_of(const std::string& metric) const {
    const auto found = descriptions_.find(metric);
    return found == descriptions_.end() ? MetricDescription{} : found->second;
  }

  void add(const CellKey& key, const MetricRow& row, double a, double b, Verdict verdict) {
    const MetricDescription description = description_of(row.metric);
    const bool equal = verdict == Verdict::same;  // inf - inf and undefined values have no difference of their own
    if (verdict == Verdict::only_in_a || verdict == Verdict::only_in_b) result_.incomplete = true;
    result_.rows.push_back({.cell = key,
                            .metric = row.metric,
                            .subject = row.subject,
                            .a = a,
                            .b = b,
                            .difference = equal ? 0.0 : b - a,
                            .unit = row.unit,
                            .direction = description.direction,
                            .tolerance = description.tolerance,
                            .verdict = verdict,
                            .note = {}});
  }

  /// Runs kept as baselines may have no recordings.
  void compare_recordings(const CellKey& key) {
    if (!seen_.insert({key.scenario, key.seed}).second) return;
    const fs::path a = recording_path(a_, key.scenario, key.seed);
    const fs::path b = recording_path(b_, key.scenario, key.seed);
    if (!fs::exists(a / "scan.json") || !fs::exists(b / "scan.json")) return;
    if (stated_recording_hash(a) != stated_recording_hash(b))
      result_.notes.push_back("the recordings of " + key.scenario + "/" + std::to_string(key.seed) + " differ");
  }

  fs::path a_;
  fs::path b_;
  std::map<std::string, MetricDescription> descriptions_;
  std::set<std::pair<std::string, std::uint64_t>> seen_;
  Comparison result_;
};

std::string_view to_string(Direction direction) {
  switch (direction) {
    case Direction::lower_is_better:
      return "lower_is_better";
    case Direction::higher_is_better:
      return "higher_is_better";
    case Direction::target:
      return "target";
    case Direction::neither:
      break;
  }
  return "neither";
}

}  // namespace

std::string_view to_string(Verdict verdict) {
  static constexpr std::string_view kNames[] = {"same",   "within",    "better",    "worse",     "changed",
                                                "timing", "only_in_a", "only_in_b", "not_judged"};
  return kNames[static_cast<std::size_t>(verdict)];
}

int Comparison::exit_code() const {
  const bool worse = counts.contains(Verdict::worse);
  if (worse) return incomplete ? 5 : 1;
  return incomplete ? 4 : 0;
}

Comparison compare_runs(const fs::path& a, const fs::path& b, const std::map<std::string, double>& tolerances) {
  return Comparer(a, b, tolerances).compare();
}

std::string comparison_csv(const Comparison& comparison) {
  CsvWriter csv({"scenario", "pipeline", "seed", "metric", "subject", "a", "b", "difference", "unit", "direction",
                 "tolerance", "verdict"});
  for (const auto& row : comparison.rows) {
    csv.text(row.cell.scenario).text(row.cell.pipeline).seed(row.cell.seed).text(row.metric);
    csv.text(row.note.empty() ? row.subject : row.note).number(row.a).number(row.b).number(row.difference);
    csv.text(row.unit).text(to_string(row.direction)).number(row.tolerance).text(to_string(row.verdict)).end_row();
  }
  return csv.str();
}

}  // namespace scanbench::harness
