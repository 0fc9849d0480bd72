// Reading published values.
#include "harness/analysis/published.hpp"

#include <limits>

#include "harness/files/atomic_file.hpp"
#include "harness/files/csv.hpp"

namespace scanbench::harness {

std::vector<PublishedValue> load_published(const std::filesystem::path& path) {
  const CsvTable csv(read_file(path), path, {"metric", "subject", "method", "value", "unit"});
  const bool tables = csv.has("table");
  std::vector<PublishedValue> values;
  for (std::size_t r = 0; r < csv.rows(); ++r) {
    const std::string& unit = csv.text(r, "unit");
    const bool rating = unit == "rating";
    const double per_unit = unit == "cm" ? 100.0 : 1.0;  // divided by: 0.39 / 100 is 0.0039 to the last bit
    values.push_back({.metric = csv.text(r, "metric"),
                      .subject = csv.text(r, "subject"),
                      .method = csv.text(r, "method"),
                      .value = rating ? std::numeric_limits<double>::quiet_NaN() : csv.number(r, "value") / per_unit,
                      .printed = csv.text(r, "value"),
                      .unit = rating ? "" : unit,
                      .table = tables ? csv.text(r, "table") : ""});
  }
  return values;
}

MethodName split_method(const std::string& method) {
  const std::size_t blank = method.rfind(' ');
  if (blank == std::string::npos || method.find('=', blank) == std::string::npos) return {method, ""};
  return {method.substr(0, blank), method.substr(blank + 1)};
}

}  // namespace scanbench::harness
