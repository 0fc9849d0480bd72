// The subjects of benchmarks, as data.
#include "harness/study/scenario/benchmark_subject.hpp"

#include <algorithm>

#include "core/error.hpp"

namespace scanbench::study {
namespace {

using enum metrics::Direction;

BenchmarkSubject extractors() {
  return {
      .slot = "extract",
      .noun = "extractor",
      .time_metric = "t_scan",
      .counted = "true lines",
      .count_metric = "recall",
      .columns =
          {{"f1", "F1 [%]", 100, 2, false, higher_is_better, "harmonic mean of precision and recall; decides the rank"},
           {"precision", "precision [%]", 100, 2, false, higher_is_better,
            "true lines over all lines found: true / (true + false + split)"},
           {"recall", "recall [%]", 100, 2, false, higher_is_better, "true lines over lines that are there"},
           {"split", "split [%]", 100, 2, false, lower_is_better, "share of the found lines that repeat a true line"},
           {"merged", "merged [%]", 100, 2, false, lower_is_better,
            "share of the found lines that cover more than half of two true lines of different walls"},
           {"overlap", "overlap [%]", 100, 2, false, higher_is_better,
            "common extent of a true line and its match over the extent of both together"},
           {"sigma_offset", "σ offset [cm]", 100, 3, false, lower_is_better,
            "root mean square distance of the matches' midpoints from the true line"},
           {"sigma_angle", "σ angle [°]", 1, 3, false, lower_is_better,
            "root mean square angle between the matches and the true line"},
           {"efficiency_offset", "offset / bound", 1, 2, true, target,
            "mean square error of the offset at the true line's midpoint over its Cramér–Rao bound; 1 is the best that "
            "the readings allow; lines with 20 returns or more",
            1.0},
           {"efficiency_angle", "angle / bound", 1, 2, true, target,
            "mean square error of the angle over its Cramér–Rao bound; 1 is the best that the readings allow; lines "
            "with 20 returns or more",
            1.0},
           {"t_scan", "time [µs]", 1, 2, true, lower_is_better, "median CPU time per scan"},
           {"t_ratio", "time ratio", 1, 2, true, lower_is_better,
            "CPU time over that of the baseline in the same condition and seed"}},
      .required = {{"segments", ""}, {"efficiency", "matches"}, {"timing", ""}},
      .fair = {"f1", 0.05,
               "* marks the best value; of errors, times and other costs among extractors within 5 points of the best "
               "F1. An extractor with missing cells has no mark."},
      .bound = {"efficiency_offset", "line offsets"},
      .method =
          "A true line is a run of consecutive beams on one wall with at least 9 returns over 0.5 m. A found line "
          "matches it if they differ by at most 10° and 15 cm and overlap by more than half of the shorter; pairs are "
          "one to one, by decreasing overlap. Found lines shorter than 0.5 m that match nothing are skipped. For every "
          "seed a value is averaged over the conditions with equal weight; the table shows the mean over the seeds "
          "with its 95 % interval. Undefined values are "
          "left out. * marks the best.",
      .limits =
          // NOLINTNEXTLINE(*-suspicious-missing-comma): sentences over two lines
      {"The seeds change the noise, not the worlds: intervals and tests show that a difference would recur on "
       "these worlds, not that it would on others. \"Best in\" shows how much it depends on the condition.",
       "Errors are those of found lines that passed the gate of the matching. An extractor that finds only easy "
       "lines has smaller errors than one that finds all, and no error can be much larger than the gate.",
       "The bound is that of a line whose beams are known, from the returns between its first and last beam. A "
       "ratio below 1 is possible if an extractor used beams of two runs of one wall for one line.",
       "Noise is Gaussian, equal at all ranges, and known to the extractors that take it as a parameter; there are "
       "no mixed pixels, rounding or moving bodies. Walls are straight. Returns are lost only where a world or a "
       "sensor above says so.",
       "A lost return does not end a true line: an extractor that ends its line where many returns in a row are "
       "missing has a split or a false line there.",
       "Times are CPU times on a machine that may have been busy; the ratio to the baseline, in the same condition "
       "and seed, varies less."},
      .shows_example = true,
      .over_start = ""};
}

BenchmarkSubject matchers() {
  return {
      .slot = "match",
      .noun = "matcher",
      .time_metric = "t_match",
      .counted = "pairs that determine a pose",
      .count_metric = "pose_unmatched",
      .columns =
          {{"pose_efficiency", "MSE / bound", 1, 2, true, lower_is_better,
            "geometric mean of the two columns that follow; decides the rank"},
           {"pose_efficiency_position", "position / bound", 1, 2, true, lower_is_better,
            "mean square error of the position over its Cramér–Rao bound, walls unknown; 1 is the best that the "
            "readings of both scans allow"},
           {"pose_efficiency_heading", "heading / bound", 1, 2, true, lower_is_better,
            "mean square error of the heading over its Cramér–Rao bound, walls unknown; 1 is the best that the "
            "readings of both scans allow"},
           {"pose_error_position", "position [mm]", 1000, 2, true, lower_is_better,
            "root mean square error of the matched position"},
           {"pose_error_position_max", "largest [mm]", 1000, 1, false, lower_is_better,
            "largest error of a matched position in a condition; shows wrong matches, which a geometric mean hides"},
           {"pose_error_heading", "heading [°]", 1, 3, true, lower_is_better,
            "root mean square error of the matched heading"},
           {"pose_nees", "NEES", 1, 2, false, target,
            "mean normalised squared error; 3 is honest, more is overconfident, less cautious; \"conditions\": the "
            "least "
            "and the greatest mean of a condition",
            3.0, true},
           {"pose_unmatched", "unmatched [%]", 100, 2, false, lower_is_better,
            "share of the pairs that determine a pose for which the matcher has no match or says that a motion "
            "is open"},
           {"ate_position", "ATE [cm]", 100, 2, true, lower_is_better,
            "root mean square distance of the chained positions from the true ones, after the motion of the plane that "
            "fits positions and headings best, a radian counting as 1 m (lever_m)"},
           {"ate_heading", "ATE [°]", 1, 2, true, lower_is_better,
            "root mean square difference of the chained headings from the true ones, after the same motion as the "
            "positions"},
           {"t_match", "time [µs]", 1, 1, true, lower_is_better, "median CPU time of a match, lines not included"},
           {"t_ratio", "time ratio", 1, 2, true, lower_is_better,
            "CPU time over that of the baseline in the same condition and seed"}},
      .required = {{"pose_efficiency", "errors"}, {"trajectory", ""}, {"timing", ""}},
      .fair = {"pose_unmatched", 0.05,
               "* marks the best value, among matchers whose share of unmatched pairs is within 5 points of the "
               "smallest; of times among those of them whose MSE / bound is at most twice the best. A matcher with "
               "missing cells has no mark.",
               2.0},
      .bound = {"pose_efficiency", "poses"},
      .method =
          "Consecutive scans are matched, with the odometry between them as the guess. A pair counts if the "
          "unknown-walls bound of its pose leaves no motion a standard deviation above 25 cm. For every seed a value "
          "is averaged over the conditions with equal weight; the table shows the mean over the seeds with its 95 % "
          "interval. Undefined values are left out. * marks the best.",
      .limits =
          // NOLINTNEXTLINE(*-suspicious-missing-comma): sentences over two lines
      {"The seeds change the noise and the guesses, not the worlds: intervals and tests show that a difference "
       "would recur on these worlds, not that it would on others. \"Best in\" shows how much it depends on the "
       "condition.",
       "Unmatched pairs are in no error: a matcher that answers only easy pairs has smaller errors than one that "
       "always answers.",
       "The bound is that of a matcher with known assignments of beams to walls. Ends of walls are not in it, so "
       "that a ratio below 1 is possible.",
       "Noise is Gaussian, equal at all ranges, and known to the matchers; there are no mixed pixels or moving "
       "bodies. Walls are straight. Returns are lost only where a world or a sensor above says so.",
       "Times are CPU times on a machine that may have been busy; the ratio to the baseline, in the same condition "
       "and seed, varies less."},
      .shows_example = false,
      .over_start = ""};
}

BenchmarkSubject aligners() {
  return {
      .slot = "align",
      .noun = "aligner",
      .time_metric = "t_align",
      .counted = "",
      .count_metric = "",
      .columns = {{"placed", "scans placed [%]", 100, 1, false, higher_is_better,
                   "share of the scans within 10 cm and 2° of their true poses, after the motion common to all scans "
                   "is removed; decides the rank"},
                  {"all_placed", "all placed [%]", 100, 1, false, higher_is_better,
                   "share of the runs in which every scan is placed"},
                  {"error_ratio", "error / start", 1, 3, true, lower_is_better,
                   "mean position error over that of the given poses; above 1 the aligner made them worse"},
                  {"position_error", "position [cm]", 100, 1, true, lower_is_better, "mean position error of a scan"},
                  {"heading_error", "heading [°]", 1, 2, true, lower_is_better, "mean heading error of a scan"},
                  {"alignment_efficiency", "MSE / bound", 1, 1, true, lower_is_better,
                   "mean square error over the Cramér–Rao bound of all poses together, walls unknown: geometric mean "
                   "of position and heading, over the scans that the data determine to 10 cm; 1 is the best that the "
                   "readings allow"},
                  {"t_align", "time [ms]", 1e-3, 1, true, lower_is_better,
                   "CPU time of an alignment, lines not included"},
                  {"t_ratio", "time ratio", 1, 2, true, lower_is_better,
                   "CPU time over that of the baseline in the same condition and seed"}},
      .required = {{"alignment", ""}, {"timing", ""}},
      .fair = {"placed", 0.05,
               "* marks the best value; of errors and times among aligners within 5 points of the largest share of "
               "scans placed. An aligner with missing cells has no mark."},
      .bound = {"alignment_efficiency", "poses"},
      .method =
          "Every scan is given with a pose whose error is drawn from a normal distribution; the poses are not chained. "
          "An aligner that gives no answer leaves the poses as they were given, and these are scored. For every seed a "
          "value is averaged over the conditions with equal weight; the table shows the mean over the seeds with its "
          "95 % interval. Undefined values are left out. * "
          "marks the best.",
      .limits =
          // NOLINTNEXTLINE(*-suspicious-missing-comma): sentences over two lines
      {"The seeds change the noise and the given poses, not the worlds: intervals and tests show that a difference "
       "would recur on these worlds, not that it would on others. \"Best in\" shows how much it depends on the "
       "condition.",
       "Every aligner has one set of parameters for all conditions. Its radius or gate is that of the middle start "
       "error: who knows that the given poses are better or worse can do better.",
       "The bound is that of an aligner that is told which beams see which wall. Ends of walls are not in it.",
       "Noise is Gaussian, equal at all ranges; there are no mixed pixels, lost returns or moving bodies. Walls "
       "are straight.",
       "Times are CPU times on a machine that may have been busy; the ratio to the baseline, in the same condition "
       "and seed, varies less."},
      .shows_example = false,
      .over_start = "all_placed"};
}

const std::vector<BenchmarkSubject>& subjects() {
  static const std::vector<BenchmarkSubject> all{extractors(), matchers(), aligners()};
  return all;
}

}  // namespace

bool BenchmarkColumn::is_share() const {
  return head.ends_with(" [%]");
}

std::string BenchmarkColumn::name() const {
  return head.substr(0, head.find(" ["));
}

metrics::MetricDescription BenchmarkColumn::description() const {
  metrics::MetricDescription result;
  result.metric = metric;
  result.direction = direction;
  result.target = target;
  result.is_share = is_share();
  return result;
}

std::vector<std::string> benchmark_slots() {
  std::vector<std::string> slots;
  for (const auto& subject : subjects()) slots.push_back(subject.slot);
  return slots;
}

const BenchmarkSubject& benchmark_subject(std::string_view slot) {
  const auto found = std::ranges::find(subjects(), slot, &BenchmarkSubject::slot);
  if (found == subjects().end())
    throw ConfigError("no benchmark ranks modules of the kind '" + std::string(slot) + "'");
  return *found;
}

}  // namespace scanbench::study
