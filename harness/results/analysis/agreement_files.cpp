// Writes the comparison with a paper for other programs: cells.csv, orderings.csv, agreement.csv.
#include "harness/results/analysis/agreement_files.hpp"

#include <algorithm>

#include "harness/io/files/csv.hpp"
#include "harness/results/analysis/statistics.hpp"

namespace scanbench::results {
namespace {

const runs::RunFile kCellsFile("published/cells.csv");
const runs::RunFile kOrderingsFile("published/orderings.csv");
const runs::RunFile kAgreementFile("published/agreement.csv");

using Scenarios = std::vector<std::pair<std::string, std::vector<ComparedColumn>>>;

std::string cells_csv(const Scenarios& scenarios) {
  io::CsvWriter csv({"scenario", "table", "metric", "subject", "pipeline", "method", "printed", "paper", "median",
                     "low", "high", "seeds", "unit"});
  for (const auto& [scenario, columns] : scenarios)
    for (const auto& column : columns)
      for (std::size_t s = 0; s < column.subjects.size(); ++s)
        for (std::size_t m = 0; m < column.methods.size(); ++m) {
          const ComparedCell& cell = column.at(s, m);
          const MedianInterval interval = median_interval(cell.ours);
          csv.text(scenario).text(column.table).text(column.metric.metric).text(column.subjects[s]);
          csv.text(column.methods[m].pipeline).text(column.methods[m].published).text(cell.printed).number(cell.paper);
          csv.number(cell.our_median()).number(interval.low).number(interval.high);
          csv.integer(static_cast<long long>(column.seeds)).text(column.metric.unit).end_row();
        }
  return csv.str();
}

std::string orderings_csv(const Scenarios& scenarios) {
  io::CsvWriter csv({"scenario", "metric", "subject", "lower", "upper", "paper_lower", "paper_upper", "median_lower",
                     "median_upper", "holds", "seeds_holding", "seeds"});
  for (const auto& [scenario, columns] : scenarios)
    for (const auto& column : columns)
      for (const auto& ordering : orderings(column)) {
        const ComparedCell& lower = column.at(ordering.subject, ordering.lower);
        const ComparedCell& upper = column.at(ordering.subject, ordering.upper);
        csv.text(scenario).text(column.metric.metric).text(column.subjects[ordering.subject]);
        csv.text(column.methods[ordering.lower].published).text(column.methods[ordering.upper].published);
        csv.number(lower.paper).number(upper.paper).number(lower.our_median()).number(upper.our_median());
        csv.integer(ordering.holds).integer(static_cast<long long>(ordering.seeds_holding));
        csv.integer(static_cast<long long>(column.seeds)).end_row();
      }
  return csv.str();
}

// Writes a measure of one column: the paper's value, that of our medians, and the spread over single seeds.
void agreement_row(io::CsvWriter& csv, const std::string& scenario, const ComparedColumn& column,
                   const std::string& measure, const std::string& method, double paper, double of_medians,
                   const std::vector<double>& per_seed, std::size_t of) {
  const auto [low, high] = std::ranges::minmax_element(per_seed);
  csv.text(scenario).text(column.metric.metric).text(measure).text(method).number(paper).number(of_medians);
  if (per_seed.empty())
    csv.empty().empty().empty();
  else
    csv.number(*low).number(median(per_seed)).number(*high);
  csv.integer(static_cast<long long>(of)).end_row();
}

std::string agreement_csv(const Scenarios& scenarios) {
  io::CsvWriter csv(
      {"scenario", "metric", "measure", "method", "paper", "of_medians", "seed_min", "seed_median", "seed_max", "of"});
  for (const auto& [scenario, columns] : scenarios)
    for (const auto& column : columns) {
      const auto stated = orderings(column);
      if (!stated.empty()) {
        const auto held = static_cast<double>(std::ranges::count_if(stated, &Ordering::holds));
        const auto all = static_cast<double>(stated.size());
        agreement_row(csv, scenario, column, "orderings", "", all, held, orderings_per_seed(column), stated.size());
      }
      for (const auto& [measure, ties] : {std::pair{"best", Ties::shared}, std::pair{"best_alone", Ties::nobodys}})
        for (const auto& count : best_counts(column, ties))
          agreement_row(csv, scenario, column, measure, column.methods[count.method].published,
                        static_cast<double>(count.paper), static_cast<double>(count.median), count.per_seed,
                        column.printed_subjects());
      if (const Correlation r = correlation(column); r.cells > 1)
        agreement_row(csv, scenario, column, "correlation", "", 1.0, r.of_medians, r.per_seed, r.cells);
    }
  return csv.str();
}

}  // namespace

std::vector<NamedBytes> agreement_files(const Scenarios& scenarios) {
  return {{kCellsFile.name(), cells_csv(scenarios)},
          {kOrderingsFile.name(), orderings_csv(scenarios)},
          {kAgreementFile.name(), agreement_csv(scenarios)}};
}

}  // namespace scanbench::results
