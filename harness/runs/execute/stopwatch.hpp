// CPU time of the stages of an algorithm.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/trace/stage_time.hpp"
#include "core/trace/trace.hpp"

namespace scanbench::runs {

/// CPU time of the calling thread in seconds: other processes on the machine do not count.
double thread_cpu_seconds();

/// CPU time per stage, of the thread and of the programs that it calls, between start() and stop(). Time before the
/// first stage counts for that stage; a module that names none has one time without a stage. Stages are listed in the
/// order of their first appearance.
class Stopwatch {
 public:
  /// A trace whose stages are timed until stop().
  Trace start();
  void stage(Stage begun);
  /// Appends the times since start().
  void stop(std::string_view slot, int frame, std::vector<StageTime>& times);

 private:
  struct Part {
    std::optional<Stage> stage;
    double seconds = 0.0;
  };
  void close_current(double now);

  std::vector<Part> parts_;
  std::size_t current_ = 0;
  double since_ = 0.0;
};

}  // namespace scanbench::runs
