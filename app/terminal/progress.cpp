// Shows progress on standard error, so that standard output has only results and can be piped.
#include "app/terminal/progress.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <ctime>
#include <string_view>

namespace scanbench::app {
namespace {

constexpr int kBarWidth = 30;

volatile std::sig_atomic_t interrupted = 0;  // the only kind of variable that a signal handler may set

}  // namespace

std::string duration_text(double seconds) {
  if (seconds < 2) return fmt::format("{:.1f} s", seconds);
  if (seconds < 60) return fmt::format("{:.0f} s", seconds);
  const auto minutes = static_cast<long long>(seconds / 60);
  if (minutes >= 60) return fmt::format("{} h {:02} min", minutes / 60, minutes % 60);
  return fmt::format("{} min {:02} s", minutes, static_cast<long long>(seconds) % 60);
}

std::string counted(std::size_t count, const std::string& what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

void say(const std::string& text) noexcept {
  // A pipe without a reader raises SIGPIPE: it is blocked here, and removed if it was raised.
  sigset_t pipe, before;
  sigemptyset(&pipe);
  sigaddset(&pipe, SIGPIPE);
  sigprocmask(SIG_BLOCK, &pipe, &before);
  std::string_view rest = text;
  bool broken = false;
  while (!rest.empty()) {
    const ssize_t n = ::write(STDERR_FILENO, rest.data(), rest.size());
    if (n < 0 && errno == EINTR) continue;
    broken = n < 0 && errno == EPIPE;
    if (n <= 0) break;
    rest.remove_prefix(static_cast<std::size_t>(n));
  }
  const timespec now{};
  if (broken && sigismember(&before, SIGPIPE) == 0) sigtimedwait(&pipe, nullptr, &now);
  sigprocmask(SIG_SETMASK, &before, nullptr);
}

void open_standard_streams() noexcept {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(stream, F_GETFD) < 0) ::open("/dev/null", O_RDONLY);  // takes the lowest number; writing to it fails
}

InterruptGuard::InterruptGuard() {
  struct sigaction action {};
  action.sa_handler = [](int) { interrupted = 1; };
  action.sa_flags = SA_RESTART;
  sigaction(SIGINT, &action, &old_int_);
  sigaction(SIGTERM, &action, &old_term_);
  sigaction(SIGHUP, nullptr, &old_hangup_);
  if (old_hangup_.sa_handler != SIG_IGN) sigaction(SIGHUP, &action, nullptr);  // `nohup` ignores it
}

InterruptGuard::~InterruptGuard() {
  sigaction(SIGINT, &old_int_, nullptr);
  sigaction(SIGTERM, &old_term_, nullptr);
  sigaction(SIGHUP, &old_hangup_, nullptr);
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
    say(fmt::format("{:3.0f} %{}{}  {}\n", 100.0 * share, left, failed, what));
    share_ = share;
    last_ = now;
    return;
  }
  if (drawn_ && now - last_ < std::chrono::milliseconds(80) && share < 1.0) return;
  last_ = now;
  const int filled = static_cast<int>(share * kBarWidth);
  std::string bar;
  for (int i = 0; i < kBarWidth; ++i) bar += i < filled ? "█" : "░";
  say(fmt::format("\r\x1b[K{} {:3.0f} %{}{}  {}", bar, 100.0 * share, left, failed, what.substr(0, 60)));
  drawn_ = true;
}

void Progress::note(const std::string& line) {
  if (style_ == Style::silent) return;
  say(fmt::format("{}{}\n", drawn_ ? "\r\x1b[K" : "", line));
}

void Progress::finish() {
  if (drawn_) say("\r\x1b[K");
  drawn_ = false;
}

Progress::Style progress_style(bool quiet) {
  if (quiet) return Progress::Style::silent;
  return isatty(STDERR_FILENO) ? Progress::Style::bar : Progress::Style::lines;
}

std::size_t terminal_width() {
  winsize size{};
  if (isatty(STDOUT_FILENO) && ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 40) return size.ws_col;
  return 120;
}

bool use_color() {
  const char* term = std::getenv("TERM");
  return isatty(STDOUT_FILENO) != 0 && std::getenv("NO_COLOR") == nullptr &&
         (term == nullptr || std::string_view(term) != "dumb");
}

}  // namespace scanbench::app
