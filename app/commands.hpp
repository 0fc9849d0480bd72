// The verbs of the program. Each adds its options to the command line and returns what is to be done, with an exit
// code.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "harness/analysis/benchmark.hpp"
#include "harness/scenario/benchmark_spec.hpp"
#include "harness/scenario/scenario.hpp"

namespace scanbench::app {

enum ExitCode {
  kGood = 0,
  kGateFailed = 1,
  kBadInput = 2,
  kCellsFailed = 3,
  kIncomplete = 4,
  kOurBug = 70,
  kInterrupted = 130
};

/// Set by the verb that the user chose.
using Action = std::function<int()>;

struct Context {
  CLI::App& app;
  Action& action;
  std::vector<std::string> argv;
  std::filesystem::path program;  ///< argv[0]
};

void add_run(Context& context);         ///< run
void add_inspection(Context& context);  ///< check, list, describe
void add_recordings(Context& context);  ///< simulate, export
void add_results(Context& context);     ///< score, compare, figures, report

/// Scenarios of scenario and suite files, in order; `name` receives the first file's name without ending, `benchmark`
/// what a suite that stands alone ranks.
std::vector<harness::Scenario> load_inputs(const std::vector<std::string>& files, const std::vector<std::string>& sets,
                                           std::string* name = nullptr,
                                           std::optional<harness::BenchmarkSpec>* benchmark = nullptr);

/// Seeds of `--seed` in place of the scenarios' own, if there are any. Throws ConfigError for anything but whole
/// numbers that a scenario file may have, and for one that is given twice.
void give_seeds(std::vector<harness::Scenario>& scenarios, const std::vector<std::string>& texts);

}  // namespace scanbench::app
