// Reads slots whose module is a program or is in a shared library.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/io/yaml/reader.hpp"
#include "harness/study/catalog/pipeline_spec.hpp"
#include "harness/study/foreign/source.hpp"

namespace scanbench::study {

/// What slots may refer to.
struct ModuleSources {
  std::filesystem::path file;                 ///< paths are relative to its folder
  bool is_recorded = false;                   ///< the file is in a run folder: programs and libraries may be gone
  bool sandbox = false;                       ///< programs are asked under bubblewrap
  std::vector<ForeignSource> libraries = {};  ///< the modules of `plugins`
};

/// The modules of the libraries of the key `plugins`, a list of files or {file: FILE, built_by: COMMAND}; none if the
/// map has no such key. Throws PlacedError, which names the command where a library is missing or refused.
std::vector<ForeignSource> read_plugins(io::YamlMap& map, const ModuleSources& sources);

/// True for {program: [...]}, {module: NAME, plugin: FILE} and {module: NAME} of a library in `sources`.
bool is_foreign_slot(const io::YamlNode& node, const std::string& kind, const ModuleSources& sources);

/// Reads such a slot; `what` names it in messages. The program or library is asked, in a child process, for its name,
/// version and parameters. A key `identity`, which effective.yaml has, must agree with them. Of a recorded file nothing
/// is asked: identity and parameters are taken from the file. Throws PlacedError.
ModuleChoice read_foreign_slot(const io::YamlNode& node, const std::string& kind, const std::string& what,
                               const ModuleSources& sources);

/// The slot as a node that read_foreign_slot() reads back.
io::YamlNode foreign_slot_node(const ModuleChoice& choice);

/// The source with the bytes of its files instead of their folders: what the address of a cell depends on.
ForeignSource without_folders(ForeignSource source);

}  // namespace scanbench::study
