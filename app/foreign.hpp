// Options of the command line about modules that are not part of this program.
#pragma once

#include <string>
#include <vector>

#include "app/options.hpp"
#include "harness/results/figures/catalog.hpp"
#include "harness/study/foreign/source.hpp"

namespace scanbench::app {

/// --plugin FILE and --program WORD...: what a verb is to look at.
struct ForeignOptions {
  std::vector<std::string> plugins;
  std::vector<std::string> program;
};
void add_foreign_options(Verb& verb, ForeignOptions& options, bool programs);

/// The overrides of a scenario that mean the same: --plugin adds the key `plugins`, `sandbox` sets limits.sandbox.
std::vector<std::string> with_foreign(std::vector<std::string> sets, const ForeignOptions& options, bool sandbox);

/// The modules of the libraries and of the program. Throws ConfigError for those that cannot be asked.
std::vector<study::ForeignSource> foreign_sources(const ForeignOptions& options);

/// The same for the catalog.
std::vector<results::CatalogEntry> foreign_entries(const ForeignOptions& options);

}  // namespace scanbench::app
