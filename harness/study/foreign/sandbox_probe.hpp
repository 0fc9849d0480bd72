// What the sandbox of programs does on this machine, as a program in it sees it.
#pragma once

#include <map>
#include <string>

namespace scanbench::study {

/// What the sandbox promises ("no network", "own process namespace", ...), and whether it holds: as a shell finds that
/// is started in it. All are false without that look, and where the sandbox does not work.
std::map<std::string, bool> sandbox_facts(bool look);

}  // namespace scanbench::study
