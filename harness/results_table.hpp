// From the rows of summary.csv to the tables of a report, the published values beside ours.
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

/// A value that a paper prints, by the paper's name of the method.
struct PublishedValue {
  std::string metric;
  std::string subject;
  std::string method;
  double value = 0.0;   ///< in the unit of our metric
  std::string printed;  ///< as the paper prints it
  std::string unit;     ///< of `printed`
};

/// Reads a file `metric,subject,method,value,unit`; units are converted to those of our metrics (cm to m). Throws
/// ConfigError.
std::vector<PublishedValue> load_published(const std::filesystem::path& path);

/// One table per metric family of the scenario. Families that speak of many subjects (walls) have a row per subject and
/// a column per pipeline and published method; the others a row per pipeline, the published row below it, and a column
/// per metric. Over several seeds a value is the mean with the half width of its 95 % interval. The best of our
/// pipelines is marked, and the best published value among the published ones.
std::vector<Table> result_tables(const Scenario& scenario, const std::vector<SummaryRow>& rows);

}  // namespace scanbench::harness
