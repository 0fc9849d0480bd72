// Agreement of our values with the tables of a paper: the same cells side by side, and statements that do not depend on
// digits, namely which method is better than which, which is best on how many lines, and how the cells correlate.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "harness/runs/store/summary.hpp"
#include "harness/study/scenario/scenario.hpp"
#include "metrics/metric.hpp"

namespace scanbench::results {

/// One of our pipelines, the published method that it reproduces, or both.
struct ComparedMethod {
  std::string pipeline;   ///< empty: in the paper only
  std::string published;  ///< empty: ours only
};

struct ComparedCell {
  double paper;               ///< in the unit of our metric; NaN: not printed, or a rating
  std::string printed;        ///< as printed
  std::vector<double> ours;   ///< one value per seed, in the order of the scenario's seeds; NaN: undefined or missing
  double our_median() const;  ///< NaN values left out
};

/// One quantity of the paper: a column of one of its tables, for all methods and subjects (lines).
struct ComparedColumn {
  std::string table;                  ///< the paper's number of the table; may be empty
  metrics::MetricDescription metric;  ///< doc is empty if no metric computes it (a rating)
  std::string printed_unit;
  std::size_t seeds = 0;
  std::vector<ComparedMethod> methods;
  std::vector<std::string> subjects;
  std::vector<ComparedCell> cells;  ///< subject by subject: one for each method

  const ComparedCell& at(std::size_t subject, std::size_t method) const {
    return cells[subject * methods.size() + method];
  }
  bool printed(std::size_t subject) const;  ///< true if the paper prints a value of it
  std::size_t printed_subjects() const;
  bool of_lines() const { return subjects != std::vector<std::string>{"all"}; }  ///< true if subjects are single lines
};

/// The columns that the scenario's `published` file prints, in the file's order; none without such a file. Methods are
/// the scenario's pipelines; the paper's own methods only if no pipeline names one. Throws ConfigError.
std::vector<ComparedColumn> compare_with_paper(const study::Scenario& scenario,
                                               const std::vector<runs::SummaryRow>& rows);

/// The paper prints a smaller value for `lower` than for `upper`, on one subject.
struct Ordering {
  std::size_t subject = 0;
  std::size_t lower = 0;  ///< methods
  std::size_t upper = 0;
  bool holds = false;             ///< for our medians over the seeds, strictly; undefined values never hold
  std::size_t seeds_holding = 0;  ///< for the values of single seeds

  bool holds_for(const ComparedColumn& column, std::size_t seed) const {
    return column.at(subject, lower).ours[seed] < column.at(subject, upper).ours[seed];
  }
};

/// All orderings of two methods that the paper's numbers imply: methods of one setting ("SEF T=6cm", "LT T=6cm"), or
/// one family at two settings. Equal printed values imply none.
std::vector<Ordering> orderings(const ComparedColumn& column);

/// For each seed, the number of orderings that hold for its values.
std::vector<double> orderings_per_seed(const ComparedColumn& column);

/// Number of printed subjects on which no other published method is better.
struct BestCount {
  std::size_t method = 0;
  std::size_t paper = 0;
  std::size_t median = 0;        ///< by our medians over the seeds
  std::vector<double> per_seed;  ///< by the values of each seed
};
enum class Ties {
  shared,  ///< all methods that share the first place are best
  nobodys  ///< only a method that is better than every other
};
/// One count for each published method; none if the metric has no better direction.
std::vector<BestCount> best_counts(const ComparedColumn& column, Ties ties);

/// Pearson's correlation of our cells with the printed ones; NaN for fewer than two pairs or no spread.
struct Correlation {
  std::size_t cells = 0;  ///< pairs of a printed value and a median of ours
  double of_medians = 0.0;
  std::vector<double> per_seed;
};
Correlation correlation(const ComparedColumn& column);

}  // namespace scanbench::results
