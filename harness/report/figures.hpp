// The figures of a run, drawn from its files.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "harness/scenario/scenario.hpp"
#include "render/scene.hpp"

namespace scanbench::harness {

/// A figure in the run folder: figures/<name>.svg and .png.
struct FigureFile {
  std::string scenario;
  std::string name;     ///< empty: the figure had nothing to draw, and there are no files
  std::string caption;  ///< or why nothing was drawn
};

/// Draws the scenario's figures (of its first seed) from the run's recording and finished cells into run/figures, as
/// SVG and PNG, and as PDF with `pdf`. Throws ConfigError if files are missing or cannot be written.
std::vector<FigureFile> draw_figures(const std::filesystem::path& run, const Scenario& scenario, bool pdf = false,
                                     const std::function<void(double, const std::string&)>& progress = {});

/// Draws those figures of the scenarios that span all of them, once for the run, as run/figures/all_<figure>.
std::vector<FigureFile> draw_run_wide_figures(const std::filesystem::path& run, const std::vector<Scenario>& scenarios,
                                              bool pdf);

/// Writes run/figures/<name>.svg and .png, and .pdf with `pdf`.
void write_figure(const std::filesystem::path& run, const std::string& name, const render::Scene& scene, bool pdf);

/// figures/index.json: which figure belongs to which scenario, with its caption.
void save_figure_index(const std::filesystem::path& run, const std::vector<FigureFile>& figures);
std::vector<FigureFile> load_figure_index(const std::filesystem::path& run);

}  // namespace scanbench::harness
