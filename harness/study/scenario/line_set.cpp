// Reads line sets: one segment per row.
#include "harness/study/scenario/line_set.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/number_text.hpp"
#include "harness/io/exchange/log_builder.hpp"
#include "harness/io/files/placed_error.hpp"
#include "harness/io/files/text_file.hpp"

namespace scanbench::study {
namespace {

constexpr std::array<std::string_view, 4> kEnds = {"x1_m", "y1_m", "x2_m", "y2_m"};
constexpr std::array<std::string_view, 3> kSkipped = {"line", "members", "points"};
constexpr std::string_view kAllowed = "x1_m, y1_m, x2_m, y2_m, and frame, line, members, points";
constexpr double kLargestCoordinate = 1e9;  // far below the 9e15 at which doubles no longer distinguish metres

struct Columns {
  std::size_t count = 0;
  std::array<std::size_t, 4> ends{};
  std::size_t frame = 0;
  bool has_frame = false;
};

Columns read_header(const io::LogLines& lines, const std::vector<std::string_view>& words) {
  Columns columns{.count = words.size()};
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (std::ranges::count(words, words[i]) > 1)
      lines.refuse(words[i],
                   fmt::format("two columns are called {}; allowed: each once", io::quoted_excerpt(words[i])));
    const auto end = std::ranges::find(kEnds, words[i]);
    if (end != kEnds.end()) {
      columns.ends[static_cast<std::size_t>(end - kEnds.begin())] = i;
    } else if (words[i] == "frame") {
      columns.frame = i;
      columns.has_frame = true;
    } else if (std::ranges::find(kSkipped, words[i]) == kSkipped.end()) {
      lines.refuse(words[i], fmt::format("unknown column {}; allowed in the first row: {}",
                                         io::quoted_excerpt(words[i]), kAllowed));
    }
  }
  for (const std::string_view end : kEnds)
    if (std::ranges::find(words, end) == words.end())
      lines.refuse(words.front(), fmt::format("no column {}; allowed in the first row: {}", end, kAllowed));
  return columns;
}

}  // namespace

std::vector<std::vector<Segment>> parse_line_set(std::string_view text, const std::string& file) {
  return io::in_file(file, {}, [&] {
    std::vector<std::vector<Segment>> frames;
    io::LogLines lines(text);
    Columns columns;
    std::vector<std::string_view> words;
    while (lines.next()) {
      io::split_fields(lines.line().substr(0, lines.line().find('#')), words);
      if (words.empty()) continue;
      if (columns.count == 0) {
        columns = read_header(lines, words);
        continue;
      }
      if (words.size() != columns.count)
        lines.refuse(words.front(),
                     fmt::format("a row of {} fields; allowed: {}, as the first row has", words.size(), columns.count));
      std::array<double, 4> ends{};
      for (std::size_t i = 0; i < ends.size(); ++i) {
        const std::string_view word = words[columns.ends[i]];
        ends[i] = lines.number_of(word, kEnds[i]);
        if (!(std::abs(ends[i]) <= kLargestCoordinate))
          lines.refuse(word, fmt::format("{} is {}; allowed: up to 1e9 m", kEnds[i], io::quoted_excerpt(word)));
      }
      const Segment line{{ends[0], ends[1]}, {ends[2], ends[3]}};
      if (!(line.length() > 0))
        lines.refuse(words[columns.ends[0]], "a line without length; allowed: two different end points");
      if (frames.empty()) frames.emplace_back();
      if (columns.has_frame) {
        const std::string_view word = words[columns.frame];
        const auto frame = parse_integer(word);
        const auto last = static_cast<long long>(frames.size()) - 1;
        const bool next = frame && *frame == last + 1 && !frames.back().empty();
        if (!frame || (*frame != last && !next))
          lines.refuse(word,
                       fmt::format("frame is {}; allowed: 0, 1, 2, ... in this order, each with at least one line",
                                   io::quoted_excerpt(word)));
        if (next) frames.emplace_back();
      }
      frames.back().push_back(line);
    }
    if (frames.empty())
      throw io::PlacedError(
          {1, 1}, fmt::format("no line in {} rows; allowed: a row of names, then rows of numbers", lines.number()));
    return frames;
  });
}

std::vector<std::vector<Segment>> load_line_set(const std::filesystem::path& path) {
  return parse_line_set(io::read_text_file(path, io::kMaxWorldBytes), path.string());
}

Recording line_set_recording(const std::vector<std::vector<Segment>>& frames, const sim::World* world) {
  Recording recording;
  recording.observed.sensor.name = "lines";
  for (const auto& lines : frames)
    recording.observed.frames.push_back({.stamp_s = static_cast<double>(recording.observed.frames.size()),
                                         .ranges = {},
                                         .odom_from_sensor = {},
                                         .lines = lines});
  if (world != nullptr)
    recording.truth = Truth{
        .walls = world->walls, .world_from_sensor = std::vector<Pose2>(frames.size()), .ranges = {}, .wall_ids = {}};
  return recording;
}

}  // namespace scanbench::study
