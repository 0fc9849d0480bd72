// Deadlines on the monotonic clock, and waiting until one.
#pragma once

#include <poll.h>

#include <csignal>
#include <span>

namespace scanbench::io {

/// Seconds of a clock that nobody sets.
double monotonic_seconds();

/// A point in time that is `seconds` from now. Infinity is allowed: it is never over.
class Deadline {
 public:
  explicit Deadline(double seconds) : end_(monotonic_seconds() + seconds) {}
  double seconds_left() const { return end_ - monotonic_seconds(); }
  bool is_over() const { return seconds_left() <= 0.0; }

 private:
  double end_;
};

/// Waits for an event of the descriptors, for `seconds` at most, or for a signal that `mask` lets through. The mask of
/// the process applies if `mask` is null. Events are in `revents`, which are 0 if there were none.
void wait_for_events(std::span<pollfd> descriptors, double seconds, const sigset_t* mask = nullptr);

}  // namespace scanbench::io
