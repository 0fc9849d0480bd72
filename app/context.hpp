// The interface of the verbs: a verb adds its options to the command line and returns an exit code.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace scanbench::app {

enum ExitCode {
  kGood = 0,
  kGateFailed = 1,
  kBadInput = 2,
  kCellsFailed = 3,
  kIncomplete = 4,
  kGateFailedIncomplete = 5,
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

}  // namespace scanbench::app
