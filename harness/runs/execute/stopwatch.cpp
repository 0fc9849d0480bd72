// Measures thread CPU time per stage.
#include "harness/runs/execute/stopwatch.hpp"

#include <time.h>

#include <algorithm>

#include "harness/study/foreign/program.hpp"

namespace scanbench::runs {

namespace {

/// The work of a foreign program is done in another process.
double work_seconds() {
  return thread_cpu_seconds() + study::called_programs_cpu_seconds();
}

}  // namespace

double thread_cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

Trace Stopwatch::start() {
  parts_.clear();
  current_ = 0;
  since_ = work_seconds();
  return Trace({.stage = [this](Stage begun) { stage(begun); }});
}

void Stopwatch::close_current(double now) {
  parts_[current_].seconds += now - since_;
  since_ = now;
}

void Stopwatch::stage(Stage begun) {
  if (!parts_.empty()) close_current(work_seconds());
  const auto found = std::ranges::find(parts_, begun, &Part::stage);
  current_ = static_cast<std::size_t>(found - parts_.begin());
  if (found == parts_.end()) parts_.push_back({begun});
}

void Stopwatch::stop(std::string_view slot, int frame, std::vector<StageTime>& times) {
  const double now = work_seconds();
  if (parts_.empty()) parts_.push_back({});
  close_current(now);
  for (const auto& part : parts_) times.push_back({std::string(slot), part.stage, frame, part.seconds});
}

}  // namespace scanbench::runs
