// The sandbox of programs: bubblewrap.
#pragma once

#include <string>
#include <vector>

#include "harness/study/foreign/source.hpp"

namespace scanbench::study {

/// The command that runs the source's program under bubblewrap (0.8 or newer): without network, capabilities, terminal,
/// further user namespaces, sight of other processes, and the sockets at which services listen now. The file system is
/// read-only but for `setting.writable_folder`. /run, folders of temporary files, homes and `setting.hidden_folder` are
/// empty but for the folders of the program, of its files and of what Python loads.
std::vector<std::string> sandbox_command(const ForeignSource& source, const ForeignSetting& setting);

}  // namespace scanbench::study
