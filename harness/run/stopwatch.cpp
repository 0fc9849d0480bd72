// Sums of thread CPU time per stage.
#include "harness/run/stopwatch.hpp"

#include <time.h>

#include <algorithm>

namespace scanbench::harness {

double thread_cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

void Stopwatch::start() {
  parts_.clear();
  current_ = 0;
  since_ = thread_cpu_seconds();
}

void Stopwatch::close_current(double now) {
  parts_[current_].seconds += now - since_;
  since_ = now;
}

void Stopwatch::stage(std::string_view name) {
  if (!parts_.empty()) close_current(thread_cpu_seconds());
  const auto found = std::ranges::find(parts_, name, &Part::name);
  current_ = static_cast<std::size_t>(found - parts_.begin());
  if (found == parts_.end()) parts_.push_back({std::string(name)});
}

void Stopwatch::stop(std::string_view whole, std::string_view prefix, int frame, std::vector<StageTime>& times) {
  const double now = thread_cpu_seconds();
  if (parts_.empty())
    parts_.push_back({std::string(whole)});
  else
    for (auto& part : parts_) part.name = std::string(prefix) + part.name;
  close_current(now);
  for (const auto& part : parts_) times.push_back({part.name, frame, part.seconds});
}

}  // namespace scanbench::harness
