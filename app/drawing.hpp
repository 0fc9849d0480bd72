// Figures of a run, drawn in a child process.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/terminal/progress.hpp"
#include "harness/results/figures/figures.hpp"
#include "harness/study/scenario/scenario.hpp"

namespace scanbench::app {

/// Draws the figures of a run with the limits of its scenarios on time and memory: results of a million lines must not
/// take all memory of the machine. Returns why they were not drawn; the run then has no figures. Empty if they were.
/// Throws ConfigError for wrong input and what the system refuses, and Interrupted.
std::string draw_within_limits(const std::filesystem::path& run, const std::vector<study::Scenario>& scenarios,
                               const results::FigureOptions& options, Progress& progress);

}  // namespace scanbench::app
