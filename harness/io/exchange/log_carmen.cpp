// Reader of CARMEN logs: FLASER, ROBOTLASER1, and the VERTEX2 lines of graph logs.
//
//   FLASER n r1 .. rn  laser_x laser_y laser_yaw  odom_x odom_y odom_yaw  stamp host logger_stamp
//   ROBOTLASER1 type start fov resolution max accuracy remission_mode n r1 .. rn m e1 .. em
//               laser_x laser_y laser_yaw  robot_x robot_y robot_yaw  tv rv forward side turn  stamp host logger_stamp
#include "harness/io/exchange/log_carmen.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "core/number_text.hpp"
#include "harness/io/exchange/log_builder.hpp"
#include "harness/io/files/placed_error.hpp"
#include "harness/io/files/text_file.hpp"

namespace scanbench::io {
namespace {

class CarmenReader {
 public:
  CarmenReader(LogLines& lines, const LogOptions& options) : options_(options), lines_(lines), builder_(options) {}

  Recording read(const SensorModel& sensor) {
    while (!builder_.full() && lines_.next()) {
      split_words(lines_.line(), words_);
      if (words_.empty() || words_[0].front() == '#') continue;
      check_message_name();
      if (words_[0] == "FLASER" && (message_.empty() || message_ == "FLASER"))
        flaser();
      else if (words_[0] == "ROBOTLASER1" && (message_.empty() || message_ == "ROBOTLASER1"))
        robotlaser();
      else if (words_[0] == "VERTEX2")
        vertex();
    }
    if (builder_.frames() == 0)
      throw PlacedError(
          {1, 1},
          fmt::format("no FLASER or ROBOTLASER1 line in {} lines; allowed: a CARMEN log with scans", lines_.number()));
    return builder_.finish(sensor, has_stamps_);
  }

 private:
  // CARMEN's messages have names in capitals. Any other line shows that the file is no CARMEN log.
  void check_message_name() {
    const auto capital = [](char c) { return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_'; };
    if (!(words_[0].front() >= 'A' && words_[0].front() <= 'Z') || !std::ranges::all_of(words_[0], capital))
      lines_.refuse(
          words_[0],
          fmt::format("a line that begins with {}; allowed: CARMEN messages, like FLASER or ODOM, and # comments",
                      quoted_excerpt(words_[0])));
  }

  double number(std::size_t word, std::string_view what) { return lines_.number_of(words_[word], what); }

  // Reads a count of values that is followed by at least that many words.
  std::size_t count(std::size_t word, std::string_view what) {
    if (word >= words_.size()) lines_.refuse(words_.back(), fmt::format("the line ends before {}", what));
    const auto n = parse_integer(words_[word]);
    if (!n || *n < 0)
      lines_.refuse(words_[word],
                    fmt::format("{} is {}; allowed: a whole number >= 0", what, quoted_excerpt(words_[word])));
    if (static_cast<unsigned long long>(*n) > words_.size() - word - 1)
      lines_.refuse(words_[word],
                    fmt::format("{} is {}, but only {} words follow", what, *n, words_.size() - word - 1));
    return static_cast<std::size_t>(*n);
  }

  // All scans of a log have equally many words after the ranges. A different number shows a truncated or foreign line.
  void check_tail(std::size_t tail) {
    if (tail_line_ == 0) {
      tail_ = tail;
      tail_line_ = lines_.number();
    } else if (tail != tail_) {
      lines_.refuse(words_.back(),
                    fmt::format("{} words after the ranges, but the scan in line {} has {}", tail, tail_line_, tail_));
    }
  }

  void flaser() {
    message_ = "FLASER";
    const std::size_t n = count(1, "the number of ranges");
    const std::size_t tail = words_.size() - 2 - n;  // after the ranges
    if (n == 0 || (tail != 6 && tail != 7 && tail != 9))
      lines_.refuse(
          words_[1],
          fmt::format("FLASER states {} ranges and has {} words after its name; allowed: {} (ranges, two poses, "
                      "stamp, host, stamp), or {} and {} without the last words",
                      n, words_.size() - 1, n + 10, n + 8, n + 7));
    check_tail(tail);
    builder_.begin_scan(lines_, n, builder_.angles_by_rule(lines_, n));
    scan(2, n, 2 + n, tail > 6 ? std::optional(2 + n + 6) : std::nullopt);
  }

  void robotlaser() {
    message_ = "ROBOTLASER1";
    const std::size_t n = count(8, "the number of ranges");
    const std::size_t m = count(9 + n, "the number of remissions");
    const std::size_t poses = 10 + n + m;
    const std::size_t tail = words_.size() - poses;
    if (n == 0 || (tail != 12 && tail != 14))
      lines_.refuse(
          words_[8],
          fmt::format(
              "ROBOTLASER1 states {} ranges and {} remissions and has {} words after its name; allowed: {} or {}", n, m,
              words_.size() - 1, 21 + n + m, 23 + n + m));
    check_tail(tail);
    BeamAngles angles{degrees(number(2, "the start angle")), degrees(number(4, "the resolution"))};
    if (builder_.states_angles()) angles = builder_.angles_by_rule(lines_, n);
    if (angles.step_deg == 0 && n > 1)
      lines_.refuse(words_[4], "the resolution is 0; allowed: an angle between beams, or step_deg or span_deg given");
    if (std::max(std::abs(angles.first_deg), std::abs(angles.step_deg)) > 360)
      lines_.refuse(words_[2], fmt::format("beams from {} deg in steps of {} deg; allowed: up to 360", angles.first_deg,
                                           angles.step_deg));
    builder_.begin_scan(lines_, n, angles);
    scan(9, n, poses, poses + 11);
  }

  void vertex() {
    if (words_.size() < 5)
      lines_.refuse(words_[0], "a VERTEX2 line of fewer than 5 words; allowed: VERTEX2 id x y yaw");
    vertex_ = builder_.pose(lines_, number(2, "x"), number(3, "y"), number(4, "yaw"));
  }

  // The pose of this kind of the scan in this line, whose two triples begin at word `triples`.
  Pose2 pose(LogPoses kind, std::size_t triples) {
    if (kind == LogPoses::none) return {};
    if (kind == LogPoses::vertex) {
      if (!vertex_)
        lines_.refuse(words_[0], "no VERTEX2 line before this scan; allowed: one before each, or other poses");
      return *vertex_;
    }
    const std::size_t at = kind == LogPoses::odometry ? triples + 3 : triples;
    return builder_.pose(lines_, number(at, "x"), number(at + 1, "y"), number(at + 2, "yaw"));
  }

  // Ranges from word `first`, two pose triples from word `poses`.
  void scan(std::size_t first, std::size_t n, std::size_t poses, std::optional<std::size_t> stamp) {
    lines_.check_last_number(words_);
    if (!builder_.wants_scan()) return;
    Frame frame;
    frame.ranges.reserve(n);
    for (std::size_t i = 0; i < n; ++i) frame.ranges.push_back(builder_.reading(number(first + i, "a range")));
    frame.odom_from_sensor = pose(options_.poses, poses);
    if (options_.compare_poses != LogPoses::none) builder_.add_reference(pose(options_.compare_poses, poses));
    vertex_.reset();
    if (stamp)
      frame.stamp_s = number(*stamp, "the stamp");
    else
      has_stamps_ = false;
    builder_.add(std::move(frame));
  }

  const LogOptions& options_;
  LogLines& lines_;
  LogBuilder builder_;
  std::vector<std::string_view> words_;
  std::string_view message_;  // the message whose scans are read: the first one that occurs
  std::optional<Pose2> vertex_;
  std::size_t tail_ = 0;  // words after the ranges
  int tail_line_ = 0;
  bool has_stamps_ = true;
};

}  // namespace

Recording parse_carmen(LogLines& lines, const LogOptions& options, const SensorModel& sensor) {
  return CarmenReader(lines, options).read(sensor);
}

}  // namespace scanbench::io
