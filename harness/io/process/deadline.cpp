// Reads the monotonic clock and waits with ppoll().
#include "harness/io/process/deadline.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>

namespace scanbench::io {
namespace {

constexpr double kLongestPoll = 24 * 3600.0;  // of one ppoll(), s: infinity is not a timespec

}  // namespace

double monotonic_seconds() {
  timespec t{};
  ::clock_gettime(CLOCK_MONOTONIC, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

void wait_for_events(std::span<pollfd> descriptors, double seconds, const sigset_t* mask) {
  const double longest = std::clamp(seconds, 0.0, kLongestPoll);
  const timespec timeout{static_cast<time_t>(longest), static_cast<long>(1e9 * (longest - std::floor(longest)))};
  if (::ppoll(descriptors.data(), descriptors.size(), &timeout, mask) > 0) return;
  for (pollfd& descriptor : descriptors) descriptor.revents = 0;  // a signal leaves them as they were
}

}  // namespace scanbench::io
