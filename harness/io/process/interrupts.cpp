// Notes signals while they are blocked.
#include "harness/io/process/interrupts.hpp"

#include <array>
#include <ctime>
#include <iterator>

#include "core/error.hpp"
#include "harness/io/process/descendants.hpp"

namespace scanbench::io {
namespace {

constexpr int kInterrupts[] = {SIGINT, SIGTERM, SIGHUP};

// Signal handlers belong to the process, and so does what they note.
bool watch_exists = false;
volatile std::sig_atomic_t interrupt_seen = 0;
volatile std::sig_atomic_t sender_seen = 0;
std::array<struct sigaction, std::size(kInterrupts)> old_actions;
sigset_t held;
sigset_t old_mask;

/// Signals are delivered during ppoll() only, so that reading files is safe here.
void note_interrupt(const siginfo_t& info) {
  const pid_t sender = info.si_code <= 0 ? branch_of(info.si_pid) : 0;
  if (sender > 0)
    sender_seen = sender;
  else if (interrupt_seen != SIGTERM)
    interrupt_seen = info.si_signo;
}

void on_interrupt(int, siginfo_t* info, void*) {
  note_interrupt(*info);
}

/// While pipes have bytes to read, ppoll() returns before it delivers a signal, so pending signals are taken here.
void take_pending_signals() {
  const timespec now{0, 0};
  siginfo_t info{};
  while (::sigtimedwait(&held, &info, &now) > 0) note_interrupt(info);
}

}  // namespace

InterruptWatch::InterruptWatch() {
  SCANBENCH_ASSERT(!watch_exists);
  watch_exists = true;
  interrupt_seen = 0;
  sender_seen = 0;
  ::sigemptyset(&held);
  for (std::size_t i = 0; i < std::size(kInterrupts); ++i) {
    ::sigaction(kInterrupts[i], nullptr, &old_actions[i]);
    if (kInterrupts[i] == SIGHUP && old_actions[i].sa_handler == SIG_IGN) continue;
    struct sigaction action {};
    action.sa_sigaction = on_interrupt;
    action.sa_flags = SA_SIGINFO;
    ::sigaction(kInterrupts[i], &action, nullptr);
    ::sigaddset(&held, kInterrupts[i]);
  }
  ::sigprocmask(SIG_BLOCK, &held, &old_mask);
}

InterruptWatch::~InterruptWatch() {
  ::sigprocmask(SIG_SETMASK, &old_mask, nullptr);
  for (std::size_t i = 0; i < std::size(kInterrupts); ++i) ::sigaction(kInterrupts[i], &old_actions[i], nullptr);
  watch_exists = false;
}

int InterruptWatch::signal() {
  take_pending_signals();
  return interrupt_seen;
}

pid_t InterruptWatch::sender() {
  return sender_seen;
}

const sigset_t& InterruptWatch::outer_mask() {
  return old_mask;
}

void InterruptWatch::end_in_child() {
  for (const int number : kInterrupts)
    if (::sigismember(&held, number) == 1) std::signal(number, SIG_DFL);
  ::sigprocmask(SIG_SETMASK, &old_mask, nullptr);
}

}  // namespace scanbench::io
