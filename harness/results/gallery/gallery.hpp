// The pictures and tables of a catalogue, made from a run of its scenarios, and the page that shows them.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "harness/results/document/document.hpp"
#include "harness/results/document/table.hpp"
#include "harness/results/figures/figures.hpp"
#include "harness/results/gallery/catalogue.hpp"

namespace scanbench::results {

/// An entry of a catalogue as it was made.
struct MadeEntry {
  CatalogueEntry entry;
  std::vector<FigureFile> files;  ///< of a figure; empty if there was nothing to draw
  std::vector<Table> tables;      ///< of a table
  std::string failure;            ///< why there is neither; empty if there is
};

/// Draws every entry from the run into the folder of the options. A figure that has nothing to draw is a failure of its
/// entry, not an exception. Throws ConfigError for what cannot be read or written.
std::vector<MadeEntry> make_entries(const std::filesystem::path& run, const Catalogue& catalogue,
                                    const FigureOptions& options,
                                    const std::function<void(double, const std::string&)>& progress);

/// "scanbench figures scenarios/figures.yaml --entry NAME": makes one entry again.
std::string command_of(const Catalogue& catalogue, const CatalogueEntry& entry);

/// The page of the folder: thumbnail, the paper's number, caption and command of each entry in the order of the
/// catalogue, and what is absent. `stamp`: as Document::stamp.
Document gallery_document(const Catalogue& catalogue, const std::vector<MadeEntry>& made, const FigureOptions& options,
                          const std::string& stamp = "");

}  // namespace scanbench::results
