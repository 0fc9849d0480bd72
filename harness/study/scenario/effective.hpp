// The effective scenario: all defaults are stated, and the form is canonical.
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace scanbench::study {

struct Scenario;

/// Paths of copies of a scenario's files, relative to the folder of its effective.yaml. Empty: there is no copy.
struct StoredInputs {
  std::string published;
  std::string lines;
  std::string walls;  ///< the table of the world's walls (wall_table.hpp); without it they are listed
};

/// The scenario as YAML, with every default and the world written out. It names the copies; every other path is
/// absolute. Loading the text again, from any folder if there are no copies, gives the same scenario, the same text,
/// and the same bytes in every artefact.
std::string effective_yaml(const Scenario& scenario, const StoredInputs& stored = {});

/// Every setting of an effective scenario, from its text, by its path, for people who ask what differs between two
/// runs: "pipelines.iepf.extract.params.threshold_m" -> "0.1". Items of a list are named by their `name` or `module`,
/// else the list is one value; of a value longer than 200 characters (a world) the hash is given. `file` is for
/// messages.
std::map<std::string, std::string> effective_settings(std::string_view text, const std::string& file);

}  // namespace scanbench::study
