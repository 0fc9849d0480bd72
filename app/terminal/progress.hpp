// Progress of long work: a bar on a terminal, else a line per tenth of the work or per minute, nothing with --quiet.
#pragma once

#include <csignal>

#include <chrono>
#include <cstddef>
#include <string>

namespace scanbench::app {

/// Thrown when the user has interrupted the program.
struct Interrupted {};

/// Writes to standard error, like fmt::print(stderr, ...), but never fails: a log file on a full disk or a pipe that
/// nobody reads must not end a run.
void say(const std::string& text) noexcept;

/// "8 s", "3 min 05 s", "2 h 10 min"; "0.3 s" below two seconds.
std::string duration_text(double seconds);

/// "1 cell", "3 cells".
std::string counted(std::size_t count, const std::string& what);

/// Opens those of standard input, output and error that the caller has closed, so that no other file gets their
/// descriptors.
void open_standard_streams() noexcept;

/// While one exists, SIGINT, SIGTERM and SIGHUP end the work at the next Progress::update(), which throws Interrupted,
/// so that unfinished files are completed or removed.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

 private:
  struct sigaction old_int_ {};
  struct sigaction old_term_ {};
  struct sigaction old_hangup_ {};
};

class Progress {
 public:
  enum class Style { silent, lines, bar };

  explicit Progress(Style style) : style_(style) {}
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress() { finish(); }

  /// The completed share of the whole work, in [0, 1], and the name of the current step.
  void update(double share, const std::string& what);
  /// Counts a cell that failed; the bar and the lines show how many have.
  void failure() { ++failures_; }
  /// A line above the bar.
  void note(const std::string& line);
  /// Removes the bar.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;
  Style style_;
  Clock::time_point start_ = Clock::now();
  Clock::time_point last_ = {};
  double share_ = -1.0;  ///< at the last line
  int failures_ = 0;
  bool drawn_ = false;
};

/// A bar if standard error is a terminal, else lines.
Progress::Style progress_style(bool quiet);

/// Characters in a line of standard output; 120 if it is not a terminal.
std::size_t terminal_width();

/// Colour on standard output: a terminal, NO_COLOR unset, TERM not "dumb".
bool use_color();

}  // namespace scanbench::app
