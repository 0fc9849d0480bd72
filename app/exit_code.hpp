// The exit codes of the program.
#pragma once

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

}  // namespace scanbench::app
