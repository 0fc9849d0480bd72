// The catalog of all registered modules, sensors and formats, as `list`, `describe` and docs/modules.md show it.
#pragma once

#include <string>
#include <vector>

#include "core/params.hpp"
#include "core/registry.hpp"

namespace scanbench::results {

struct CatalogEntry {
  std::string kind;  ///< extract, merge, match, align, map, metrics, figure, trajectory, sensor, recording
  ModuleInfo info;
  std::vector<ParamSpec> params;
  std::vector<std::string> notes;          ///< further lines: the rows of a metric family
  std::vector<std::string> required = {};  ///< parameters that must be given: their defaults are unused
};

/// By kind, then by name.
std::vector<CatalogEntry> catalog();

/// The entries of one kind, in the singular or plural; "modules" selects the modules of pipelines, an empty kind
/// selects everything. Throws ConfigError, naming the kinds, if there are none.
std::vector<CatalogEntry> catalog_of_kind(const std::string& kind);

/// The entries of that name, of that "kind/name", or of that kind; single metrics of a family included. Throws
/// ConfigError, naming the nearest, if there are none.
std::vector<CatalogEntry> find_in_catalog(const std::string& name);

std::string describe_text(const CatalogEntry& entry);
std::string catalog_text(const std::vector<CatalogEntry>& entries);
std::string catalog_markdown(const std::vector<CatalogEntry>& entries);
std::string catalog_json(const std::vector<CatalogEntry>& entries);

}  // namespace scanbench::results
