// Everything goes to standard error, so that standard output stays a result that can be piped.
#include "app/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace scanbench::app {
namespace {

constexpr int kWidth = 30;

volatile std::sig_atomic_t interrupted = 0;  // a handler reaches nothing else

std::string duration_text(double seconds) {
  if (seconds < 60) return fmt::format("{:.0f} s", seconds);
  const int minutes = static_cast<int>(seconds / 60);
  return fmt::format("{} min {:02} s", minutes, static_cast<int>(seconds) % 60);
}

}  // namespace

InterruptGuard::InterruptGuard() {
  struct sigaction action {};
  action.sa_handler = [](int) { interrupted = 1; };
  action.sa_flags = SA_RESTART;
  sigaction(SIGINT, &action, &old_int_);
  sigaction(SIGTERM, &action, &old_term_);
}

InterruptGuard::~InterruptGuard() {
  sigaction(SIGINT, &old_int_, nullptr);
  sigaction(SIGTERM, &old_term_, nullptr);
}

void Progress::update(double share, const std::string& what) {
  if (interrupted != 0) throw Interrupted{};
  if (style_ == Style::silent) return;
  share = std::clamp(share, 0.0, 1.0);
  const auto now = Clock::now();
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  const std::string failed = failures_ > 0 ? fmt::format(", {} failed", failures_) : "";
  const std::string left =
      share > 0.02 && share < 1.0 && elapsed > 2 ? ", " + duration_text(elapsed * (1 - share) / share) + " left" : "";
  if (style_ == Style::lines) {
    if (what.empty() || (share - share_ < 0.1 && now - last_ < std::chrono::minutes(1))) return;
    fmt::print(stderr, "{:3.0f} %{}{}  {}\n", 100.0 * share, left, failed, what);
    share_ = share;
    last_ = now;
    return;
  }
  if (drawn_ && now - last_ < std::chrono::milliseconds(80) && share < 1.0) return;
  last_ = now;
  const int filled = static_cast<int>(share * kWidth);
  std::string bar;
  for (int i = 0; i < kWidth; ++i) bar += i < filled ? "█" : "░";
  fmt::print(stderr, "\r\x1b[K{} {:3.0f} %{}{}  {}", bar, 100.0 * share, left, failed, what.substr(0, 60));
  std::fflush(stderr);
  drawn_ = true;
}

void Progress::note(const std::string& line) {
  if (style_ == Style::silent) return;
  fmt::print(stderr, "{}{}\n", drawn_ ? "\r\x1b[K" : "", line);
}

void Progress::finish() {
  if (drawn_) fmt::print(stderr, "\r\x1b[K");
  drawn_ = false;
}

Progress::Style progress_style(bool quiet) {
  if (quiet) return Progress::Style::silent;
  return isatty(STDERR_FILENO) ? Progress::Style::bar : Progress::Style::lines;
}

bool use_color() {
  const char* term = std::getenv("TERM");
  return isatty(STDOUT_FILENO) != 0 && std::getenv("NO_COLOR") == nullptr &&
         (term == nullptr || std::string_view(term) != "dumb");
}

}  // namespace scanbench::app
