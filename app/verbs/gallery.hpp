// Makes all figures and tables of a catalogue.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/results/figures/figures.hpp"

namespace scanbench::app {

struct GalleryOptions {
  std::filesystem::path catalogue;
  std::filesystem::path out;      ///< empty: out/<name of the catalogue>
  std::vector<std::string> only;  ///< entries; empty: all
  int jobs = 1;
  bool quiet = false;
  results::FigureOptions figures;
  std::vector<std::string> argv;
};

/// Runs the scenarios that the catalogue needs into OUT/run, draws its entries into OUT and writes index.html and
/// gallery.md there. Returns the exit code.
int make_gallery(GalleryOptions options);

}  // namespace scanbench::app
