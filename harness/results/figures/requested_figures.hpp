// Figures by name: those that somebody requests of a run, whether or not its scenarios list them.
#pragma once

#include <string>
#include <vector>

#include "harness/results/figures/figures.hpp"
#include "harness/study/scenario/scenario.hpp"

namespace scanbench::results {

/// The scenarios with these figures only: with the parameters that a scenario lists for one, else with their defaults.
/// Throws ConfigError for a name that is not that of a figure.
std::vector<study::Scenario> with_figures(std::vector<study::Scenario> scenarios,
                                          const std::vector<std::string>& names);

/// The index of a folder after some of its figures were drawn again: these replace those of the same name and the notes
/// on them, and new ones follow. What could not be drawn is left as it was.
std::vector<FigureFile> beside(std::vector<FigureFile> earlier, const std::vector<FigureFile>& drawn);

/// Throws ConfigError, with the reasons, if no scenario has one of these figures.
void require_drawn(const std::vector<std::string>& names, const std::vector<FigureFile>& drawn);

}  // namespace scanbench::results
