// Writes the verdict of a comparison in words.
#include "harness/results/analysis/verdict.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "core/special_values.hpp"

namespace scanbench::results {
namespace {

std::string number(double value) {
  return std::isfinite(value) ? fmt::format("{:.4g}", value) : std::string("undefined");
}

std::string with_unit(double value, const MetricChange& change) {
  return number(value) + (change.metric.unit.empty() ? "" : " " + change.metric.unit);
}

std::string counted(std::size_t count, const char* one, const char* many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

/// ": 6 of iepf in abcdef, 3 of lt in abcdef", the pipeline with the most serious change first.
std::string places_text(const std::vector<const MetricChange*>& worse) {
  constexpr std::size_t kNamed = 3;
  std::vector<std::pair<std::string, std::size_t>> places;
  for (const MetricChange* change : worse) {
    const std::string place = fmt::format("{} in {}", change->pipeline, change->scenario);
    auto known = std::ranges::find(places, place, &std::pair<std::string, std::size_t>::first);
    if (known == places.end()) known = places.insert(known, {place, 0});
    ++known->second;
  }
  if (worse.size() < 2) return "";  // the sentence on the worst change names the place
  std::string text;
  for (std::size_t i = 0; i < places.size() && i < kNamed; ++i)
    text += fmt::format("{} {} of {}", i == 0 ? ":" : ",", places[i].second, places[i].first);
  if (places.size() > kNamed)
    text += fmt::format(", and others of {}", counted(places.size() - kNamed, "pipeline", "pipelines"));
  return text;
}

std::string failure_text(const Comparison& comparison) {
  std::string text;
  const auto worse = changes_with(comparison, Finding::worse);
  if (!worse.empty()) {
    text += fmt::format("{} of {} {} worse", worse.size(), counted(comparison.gates, "gate", "gates"),
                        worse.size() == 1 ? "is" : "are");
    if (const std::size_t better = comparison.count(Finding::better))
      text += fmt::format(", {} {} better", better, better == 1 ? "is" : "are");
    text += places_text(worse);
  }
  const auto add_cells = [&text](std::size_t count, const char* one, const char* many, const char* state) {
    if (count > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", and ", counted(count, one, many), state);
  };
  const auto added = static_cast<std::size_t>(std::ranges::count(comparison.failing, "missing", &StatusChange::before));
  add_cells(comparison.broken.size(), "cell is", "cells are", "no longer ok");
  add_cells(added, "new cell is", "new cells are", "not ok");
  add_cells(comparison.failing.size() - added, "cell is", "cells are", "not ok, as before");
  text += ".";
  if (!worse.empty())
    text += fmt::format(" {}: {}.", worse.size() == 1 ? "Worse" : "The worst", change_sentence(*worse.front()));
  if (!comparison.broken.empty() || !comparison.failing.empty()) {
    const StatusChange& first = (comparison.broken.empty() ? comparison.failing : comparison.broken).front();
    text += fmt::format(" {} {}: {}.", runs::to_string(first.cell), first.after,
                        first.message.empty() ? "no message" : first.message.substr(0, first.message.find('\n')));
  }
  return text;
}

std::string incomplete_text(const Comparison& comparison) {
  if (!comparison.missing.empty())
    return fmt::format("{} missing, first {}.", counted(comparison.missing.size(), "cell is", "cells are"),
                       runs::to_string(comparison.missing.front()));
  return fmt::format("{} no values any more, first {}.", counted(comparison.absent.size(), "gate has", "gates have"),
                     comparison.absent.front());
}

/// " Of the watched metrics 8 are worse, 1 is better.", or nothing.
std::string watched_text(const Comparison& comparison) {
  std::string text;
  const auto add = [&](Finding finding, const char* word) {
    const std::size_t count = comparison.count(finding, false) - comparison.count(finding);
    if (count > 0)
      text +=
          fmt::format("{} {} {}", text.empty() ? " Of the watched metrics" : ",", counted(count, "is", "are"), word);
  };
  add(Finding::worse, "worse");
  add(Finding::better, "better");
  return text.empty() ? "" : text + ".";
}

/// Why nothing was compared.
std::string strangers_text(const Comparison& comparison) {
  if (!comparison.mended.empty())
    return fmt::format("no cell is ok in both {} and {}, so nothing was compared.", comparison.before,
                       comparison.after);
  const auto example = [](const std::vector<runs::CellKey>& cells) {
    return cells.empty() ? std::string("no cells") : "cells such as " + runs::to_string(cells.front());
  };
  return fmt::format("no cell is in both runs, so nothing was compared: {} has {}, {} has {}.", comparison.before,
                     example(comparison.missing), comparison.after, example(comparison.added));
}

/// " Not gates, and without values now: precision, recall.", or nothing.
std::string dropped_text(const Comparison& comparison) {
  constexpr std::size_t kNamed = 3;
  const auto& dropped = comparison.dropped;
  if (dropped.empty()) return "";
  std::string names;
  for (std::size_t i = 0; i < dropped.size() && i < kNamed; ++i) names += (i > 0 ? ", " : "") + dropped[i];
  if (dropped.size() > kNamed) names += fmt::format(" and {} more", dropped.size() - kNamed);
  return fmt::format(" Not gates, and without values now: {}.", names);
}

/// " 3 gates have values on fewer than three seeds ...", or nothing. Recorded logs, of which the page says it row by
/// row, are not counted.
std::string few_seeds_text(const Comparison& comparison) {
  const auto few = static_cast<std::size_t>(std::ranges::count_if(comparison.changes, [](const MetricChange& change) {
    const bool judged = change.finding == Finding::within || change.finding == Finding::better;
    return change.gate && judged && change.difference.count > 0 && change.by_tolerance() && change.by_value.empty();
  }));
  if (few == 0) return "";
  return fmt::format(" {} on fewer than three seeds, where the tolerance alone decides.",
                     counted(few, "gate changed", "gates changed"));
}

/// " Better: f1 of iepf in abcdef rose from ...", or nothing.
std::string better_text(const Comparison& comparison) {
  const auto better = changes_with(comparison, Finding::better);
  if (better.empty()) return "";
  return fmt::format(" {}: {}.", better.size() == 1 ? "Better" : "The best", change_sentence(*better.front()));
}

/// "98 equal to the bit, 20 within tolerance": those that are neither worse nor better.
std::string other_gates(const Comparison& comparison) {
  std::vector<std::string> parts;
  const auto add = [&](Finding finding, const char* words) {
    if (const std::size_t count = comparison.count(finding)) parts.push_back(fmt::format("{} {}", count, words));
  };
  add(Finding::same, "equal to the bit");
  add(Finding::within, "within tolerance");
  add(Finding::uncertain, "changed by more than the tolerance, but not on enough seeds to be certain");
  std::string text;
  for (const auto& part : parts) text += (text.empty() ? "" : ", ") + part;
  return text;
}

}  // namespace

double severity(const MetricChange& change) {
  if (change.lost > 0) return kInf;
  const double scale = std::max(change.metric.tolerance, 1e-9 * (std::fabs(change.before) + 1e-300));
  return std::fabs(change.worsening.mean) / scale;
}

std::vector<const MetricChange*> changes_with(const Comparison& comparison, Finding finding, bool gates_only) {
  std::vector<const MetricChange*> found;
  for (const auto& change : comparison.changes)
    if (change.finding == finding && (change.gate || !gates_only)) found.push_back(&change);
  std::ranges::stable_sort(found, std::ranges::greater(), [](const MetricChange* change) { return severity(*change); });
  return found;
}

std::string verdict_word(const Comparison& comparison) {
  if (comparison.compared_nothing()) return "NOT COMPARED";
  if (comparison.failed()) return "FAIL";
  return comparison.incomplete() ? "INCOMPLETE" : "PASS";
}

std::string verdict_sentence(const Comparison& comparison) {
  std::string text = verdict_word(comparison) + ": ";
  if (comparison.compared_nothing()) return text + strangers_text(comparison);
  const std::string others_text = watched_text(comparison) + dropped_text(comparison);
  if (comparison.failed()) {
    text += failure_text(comparison) + better_text(comparison);
    if (comparison.incomplete()) text += " Besides, " + incomplete_text(comparison);
    return text + others_text;
  }
  if (comparison.incomplete())
    return text + incomplete_text(comparison) +
           (comparison.cells > 0 ? " Nothing that was compared is worse." : " Nothing was compared.") + others_text;
  if (comparison.gates == 0) return text + "no metric of these runs is a gate, so nothing could fail." + others_text;
  text += fmt::format("none of {} is worse", counted(comparison.gates, "gate", "gates"));
  if (const std::size_t better = comparison.count(Finding::better))
    text += fmt::format(", {} better", counted(better, "is", "are"));
  const std::string others = other_gates(comparison);
  text += others.empty() ? "." : " (" + others + ").";
  text += few_seeds_text(comparison) + better_text(comparison);
  if (!comparison.added.empty())
    text += fmt::format(" {} new and not compared.", counted(comparison.added.size(), "cell is", "cells are"));
  return text + others_text;
}

std::string sample_text(const MetricChange& change) {
  if (!change.scans) return counted(change.pairs.size(), "seed", "seeds");
  std::string text = fmt::format("{} {} in blocks of {}", change.scans->count, change.scans->of, change.scans->block);
  if (change.scans->lost > 0) text += fmt::format(", {} without a value now", change.scans->lost);
  if (change.scans->gained > 0) text += fmt::format(", {} without one before", change.scans->gained);
  return text;
}

std::string change_sentence(const MetricChange& change) {
  const std::string what = fmt::format("{} of {} in {}", change.metric.metric, change.pipeline, change.scenario);
  if (change.lost > 0)
    return fmt::format("{} is no longer defined on {} of {}", what, change.lost,
                       counted(change.pairs.size(), "seed", "seeds"));
  const double moved = change.difference.mean;
  std::string text = fmt::format("{} {} from {} to {}", what, moved < 0 ? "fell" : "rose", number(change.before),
                                 with_unit(change.after, change));
  std::string detail = fmt::format("by {}", number(std::fabs(moved)));
  if (!change.by_tolerance()) {
    double low = std::fabs(change.difference.low);
    double high = std::fabs(change.difference.high);
    if (change.difference.low < 0 && change.difference.high > 0) {  // the interval has both signs
      low = change.difference.low;
      high = change.difference.high;
    } else if (low > high) {
      std::swap(low, high);
    }
    detail += fmt::format(", 95 % interval {} to {} over {}", number(low), number(high), sample_text(change));
  }
  if (!change.by_value.empty())
    detail += ", without an interval: " + change.by_value;
  else if (change.by_tolerance())
    detail += fmt::format(", without an interval: {} {}", counted(change.difference.count, "seed", "seeds"),
                          change.difference.count == 1 ? "is too few" : "are too few");
  return text + fmt::format(" ({}; tolerance {})", detail, number(change.metric.tolerance));
}

}  // namespace scanbench::results
