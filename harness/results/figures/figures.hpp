// The figures of a run, drawn from its files.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "harness/runs/store/run_store.hpp"
#include "harness/study/scenario/scenario.hpp"
#include "render/output_style.hpp"
#include "render/scene.hpp"

namespace scanbench::results {

/// A figure in its folder: <name>.svg, .png, .pdf, and <name>.caption.txt.
struct FigureFile {
  std::string scenario;
  std::string name;      ///< empty: the figure had nothing to draw, and there are no files
  std::string caption;   ///< or why nothing was drawn
  std::string figure{};  ///< the registered name; empty for those of a benchmark
};

/// What is drawn, how, and where.
struct FigureOptions {
  std::vector<std::string> formats{"svg", "png"};  ///< endings of the pictures: svg, png, pdf
  double dpi = 300.0;                              ///< of PNG
  render::OutputStyle style{};
  std::vector<std::string> pipelines{};  ///< only these; empty: all
  /// Figures that must be drawn (requested_figures.hpp); the folder keeps its others. Empty: those of the scenarios.
  std::vector<std::string> figures{};
  std::optional<std::size_t> frame{};  ///< the scan that figures of one scan show
  std::filesystem::path folder{};      ///< empty: run/figures
  std::string name{};                  ///< of the files, for a single figure; empty: <scenario>_<figure>
};

/// Throws ConfigError unless the scenarios have all the pipelines of the options, at least one figure has a frame if
/// the options name one, and the picture is not too large; and for a folder with files that are not figures of this
/// program.
void check_figure_options(const FigureOptions& options, const std::vector<study::Scenario>& scenarios);

/// Takes a figure; without a name the figure had nothing to draw, and the scene is empty.
using FigureSink = std::function<void(const FigureFile& figure, const render::Scene& scene)>;

/// Draws the scenario's figures (of its first seed) from the run's recording and finished cells, and gives them to
/// `sink` one by one, in the options' frame but not in their style. Throws ConfigError if files are missing, and for a
/// scan that the recording does not have.
void for_each_figure(const runs::RunStore& store, const study::Scenario& scenario, const FigureOptions& options,
                     const FigureSink& sink, const std::function<void(double, const std::string&)>& progress = {});

/// True if the figure shows the scan that `FigureOptions::frame` names, or one of its own choice without it.
bool shows_one_scan(const study::ModuleChoice& figure);

/// Draws the figures of for_each_figure() and writes them into the folder of the options. Throws ConfigError also if
/// they cannot be written.
std::vector<FigureFile> draw_figures(const runs::RunStore& store, const study::Scenario& scenario,
                                     const FigureOptions& options = {},
                                     const std::function<void(double, const std::string&)>& progress = {});

/// Draws those figures of the scenarios that span all of them, once for the run, as all_<figure>.
std::vector<FigureFile> draw_run_wide_figures(const runs::RunStore& store,
                                              const std::vector<study::Scenario>& scenarios,
                                              const FigureOptions& options);

/// The folder of the options, run/figures by default.
std::filesystem::path figure_folder(const std::filesystem::path& run, const FigureOptions& options);

/// Writes <name>.svg and what else the options name, and <name>.caption.txt, into the folder.
void write_figure(const std::filesystem::path& folder, const std::string& name, const render::Scene& scene,
                  const std::string& caption, const FigureOptions& options);

/// index.json of a folder of figures: which figure belongs to which scenario, with its caption.
void save_figure_index(const std::filesystem::path& folder, const std::vector<FigureFile>& figures);
/// Empty if there is no such file.
std::vector<FigureFile> load_figure_index(const std::filesystem::path& folder);

}  // namespace scanbench::results
