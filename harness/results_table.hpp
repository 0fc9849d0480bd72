// From the rows of summary.csv to the tables of a report.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "harness/scenario.hpp"
#include "harness/table.hpp"

namespace scanbench::harness {

/// A row of summary.csv. An empty value is NaN.
struct SummaryRow {
  std::string scenario;
  std::string pipeline;
  std::uint64_t seed = 0;
  std::string metric;
  std::string subject;
  double value = 0.0;
  std::string unit;
  std::int64_t count = 0;
};

std::vector<SummaryRow> load_summary(const std::filesystem::path& path);

/// One table per metric family of the scenario, without the metrics that are `shown_elsewhere`. Families that speak of
/// many subjects (walls) have a row per subject and a column per pipeline; the others a row per pipeline and a column
/// per metric. Over several seeds a value is the mean with the half width of its 95 % interval. The best is marked.
std::vector<Table> result_tables(const Scenario& scenario, const std::vector<SummaryRow>& rows,
                                 const std::vector<std::string>& shown_elsewhere = {});

}  // namespace scanbench::harness
