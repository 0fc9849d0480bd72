// Values that a paper prints, kept beside a scenario (key `published`) to be compared with ours.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace scanbench::harness {

/// One printed value, by the paper's name of the method.
struct PublishedValue {
  std::string metric;
  std::string subject;
  std::string method;
  double value = 0.0;   ///< in the unit of our metric; NaN for a rating, like ++
  std::string printed;  ///< as the paper prints it
  std::string unit;     ///< of `printed`
  std::string table;    ///< the paper's number of the table; may be empty
};

/// Reads a file `metric,subject,method,value,unit` with an optional column `table`; centimetres become metres. Throws
/// ConfigError with file and line.
std::vector<PublishedValue> load_published(const std::filesystem::path& path);

/// A method's name in two parts: "SEF T=6cm" is the family "SEF" with the setting "T=6cm"; a name without `=` is all
/// family.
struct MethodName {
  std::string family;
  std::string setting;
};
MethodName split_method(const std::string& method);

}  // namespace scanbench::harness
