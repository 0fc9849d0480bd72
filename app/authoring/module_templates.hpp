// The text of a new module of each kind: a small one that works, and that passes the conformance suite as it is.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace scanbench::app {

/// The kinds that have a template.
std::vector<std::string> template_kinds();

/// The source of a module. `name` is in snake_case; the class gets it in CamelCase. Throws ConfigError for a kind
/// without a template.
std::string module_source(std::string_view kind, std::string_view name);

}  // namespace scanbench::app
