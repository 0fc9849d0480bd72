// Requests to stop: SIGINT, SIGTERM and SIGHUP.
#pragma once

#include <sys/types.h>

#include <csignal>

namespace scanbench::io {

/// Blocks the three signals while it exists, and notes those that come. SIGHUP that is ignored, as `nohup` does, stays
/// so. A signal that a child of this process or a descendant has sent is not a request: it is noted with the child.
/// The process must have one thread. One watch may exist at a time.
class InterruptWatch {
 public:
  InterruptWatch();
  ~InterruptWatch();
  InterruptWatch(const InterruptWatch&) = delete;
  InterruptWatch& operator=(const InterruptWatch&) = delete;

  // These may be called while a watch exists.
  /// The signal that came; 0 if none did. SIGTERM stays once it has come.
  static int signal();
  /// The child that has sent a signal, itself or by a descendant; 0 if none did.
  static pid_t sender();
  /// The mask of the process outside of the watch. ppoll() with it delivers signals to the watch.
  static const sigset_t& outer_mask();
  /// In a forked child: the signals have their default actions, and the mask is the outer one.
  static void end_in_child();
};

}  // namespace scanbench::io
