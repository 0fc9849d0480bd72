// Values that a paper prints (key `published`), which reports show beside ours.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "harness/study/scenario/scenario.hpp"

namespace scanbench::study {

/// The largest file of published values.
inline constexpr std::size_t kMaxPublishedBytes = std::size_t{16} << 20;

/// One printed value, by the paper's name of the method.
struct PublishedValue {
  std::string metric;
  std::string subject;
  std::string method;
  double value = 0.0;   ///< in the unit of our metric; NaN for a rating, like ++
  std::string printed;  ///< as the paper prints it
  std::string unit;     ///< of `printed`
  std::string table;    ///< the paper's number of the table; may be empty
  int line = 0;         ///< in the file
};

/// Reads a file `metric,subject,method,value,unit` with an optional column `table`; centimetres become metres. Throws
/// ConfigError with file and line for values that are not numbers, for a second value of the same metric, subject and
/// method, and for a file without values.
std::vector<PublishedValue> load_published(const std::filesystem::path& path);

/// Checks the scenario's published values: the file itself, that a registered family computes every metric, in that
/// unit (or the paper prints cm and the metric is in m), and that the file has every method that a pipeline reproduces.
/// Does nothing for a scenario without such a file. Throws ConfigError.
void check_published(const Scenario& scenario);

/// A method's name in two parts: "SEF T=6cm" is the family "SEF" with the setting "T=6cm"; a name without `=` has no
/// setting.
struct MethodName {
  std::string family;
  std::string setting;
};
MethodName split_method(const std::string& method);

}  // namespace scanbench::study
