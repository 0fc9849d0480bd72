// CPU time of the stages of an algorithm.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.hpp"
#include "core/trace.hpp"

namespace scanbench::harness {

/// CPU time of the calling thread in seconds: other processes on the machine do not enter it.
double thread_cpu_seconds();

/// Thread CPU time per stage between start() and stop(). Time before the first named stage goes to that stage; a module
/// that names none has one stage, `whole`. Stages are listed in the order of their first appearance.
class Stopwatch final : public Trace {
 public:
  void start();
  void stage(std::string_view name) override;
  /// The stages since start(), as rows of `frame`, each name with `prefix` in front.
  void stop(std::string_view whole, std::string_view prefix, int frame, std::vector<StageTime>& times);

 private:
  struct Part {
    std::string name;
    double seconds = 0.0;
  };
  void close_current(double now);

  std::vector<Part> parts_;
  std::size_t current_ = 0;
  double since_ = 0.0;
};

}  // namespace scanbench::harness
