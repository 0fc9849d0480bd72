// Factors of a suite: settings that it varies in addition to its scenarios. Each level is a set of overrides.
//
//   factors:
//     sensor: {ladar: {sensor.preset: ladar_2d30}, urg: {sensor.preset: urg_04lx, sensor.quantum_m: 0}}
//     noise: {1cm: {sensor.sigma_m: 0.01}, 5cm: {sensor.sigma_m: 0.05, pipelines.iepf.extract.params.threshold_m: 0.2}}
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "harness/io/yaml/reader.hpp"

namespace scanbench::study {

/// One level of every factor.
struct Variant {
  std::string suffix;                                            ///< end of the scenarios' names: "-urg-5cm"
  std::vector<std::string> sets;                                 ///< "key=value", as after --set
  io::Mark mark;                                                 ///< of the last factor's level
  std::vector<std::pair<std::string, std::string>> levels = {};  ///< {factor, level}: {"sensor", "urg"}, ...
};

/// All combinations, the last factor varying fastest. Throws PlacedError.
std::vector<Variant> read_variants(const io::YamlNode& factors);

/// The names of the elements of lists that overrides may select by number: {"pipelines", {"sef", "iepf"}}.
using ListNames = std::map<std::string, std::vector<std::string>>;

/// Throws PlacedError, with the place of the factor's key, if an override replaces a value that a level sets, or a part
/// or the whole of it: every level would have the same value, under different names.
void refuse_sets_over_factors(const io::YamlNode& factors, const std::vector<std::string>& sets,
                              const ListNames& names);

/// The overrides whose keys begin with `section` and a dot.
std::vector<std::string> sets_of_section(const std::vector<std::string>& sets, std::string_view section);
/// The overrides that sets_of_section() leaves out.
std::vector<std::string> sets_outside_section(const std::vector<std::string>& sets, std::string_view section);

}  // namespace scanbench::study
