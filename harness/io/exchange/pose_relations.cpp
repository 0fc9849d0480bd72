// Parsing of relation rows, and the move of a relation to the frames that were read.
#include "harness/io/exchange/pose_relations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
#include <optional>
#include <utility>

#include "core/error.hpp"
#include "core/number_text.hpp"
#include "harness/io/exchange/log_builder.hpp"
#include "harness/io/files/placed_error.hpp"
#include "harness/io/files/text_file.hpp"

namespace scanbench::io {
namespace {

constexpr double kSameStamp_s = 1e-3;
constexpr double kInPlane = 1e-6;    // m and rad
constexpr double kLargestYaw = 1e5;  // rad; beyond it sine and cosine have no meaning
constexpr std::array<std::string_view, 8> kFields = {"t1", "t2", "x", "y", "z", "roll", "pitch", "yaw"};

/// The scans of a log, by their stamps or numbers, and the frames near them.
class Scans {
 public:
  explicit Scans(const RelatedScans& scans)
      : scans_(scans),
        has_poses_(std::ranges::adjacent_find(scans.world_from_sensor, std::ranges::not_equal_to{}) !=
                   scans.world_from_sensor.end()) {
    for (std::size_t k = 0; k < scans.stamps_s.size(); ++k) sorted_.emplace_back(scans.stamps_s[k], k);
    std::ranges::sort(sorted_);  // a log need not have its stamps in order
  }

  std::size_t count() const { return scans_.stamps_s.size(); }

  std::optional<std::size_t> at(double stamp_s) const {
    const auto behind = std::ranges::lower_bound(sorted_, stamp_s, {}, &Stamped::first);
    std::optional<std::size_t> nearest;
    double least = kSameStamp_s;
    const auto consider = [&](const Stamped& stamped) {
      const double away = std::abs(stamped.first - stamp_s);
      if (away > least) return;
      least = away;
      nearest = stamped.second;
    };
    if (behind != sorted_.begin()) consider(*std::prev(behind));
    if (behind != sorted_.end()) consider(*behind);
    return nearest;
  }

  /// The relation of two scans, moved to the frames nearest to them; nothing if there are no two such frames.
  std::optional<PoseRelation> between_frames(std::size_t i, std::size_t j, const Pose2& i_from_j) const {
    const std::size_t every = scans_.every;
    const std::size_t first = (i + every / 2) / every, second = (j + every / 2) / every;
    if (first == second || std::max(first, second) >= scans_.frames) return std::nullopt;
    if (!has_poses_ && (i % every != 0 || j % every != 0)) return std::nullopt;
    const PoseRelation moved{static_cast<int>(first), static_cast<int>(second),
                             motion(first * every, i) * i_from_j * motion(j, second * every)};
    const bool stays = i % every == 0 && j % every == 0;
    return stays ? PoseRelation{moved.first, moved.second, i_from_j} : moved;
  }

 private:
  using Stamped = std::pair<double, std::size_t>;

  Pose2 motion(std::size_t from, std::size_t to) const {
    return scans_.world_from_sensor[from].inverse() * scans_.world_from_sensor[to];
  }

  const RelatedScans& scans_;
  bool has_poses_;
  std::vector<Stamped> sorted_;
};

struct Row {
  std::optional<std::size_t> first, second;  ///< scans of the log
  Pose2 robot_motion;
};

double yaw_of(const LogLines& lines, std::string_view word) {
  const double yaw = lines.number_of(word, "yaw");
  if (std::abs(yaw) > kLargestYaw) lines.refuse(word, fmt::format("yaw is {}; allowed: up to 1e5 rad", yaw));
  return yaw;
}

/// A row with stamps.
Row stamped_row(const LogLines& lines, const std::vector<std::string_view>& words, const Scans& scans) {
  if (words.size() != kFields.size())
    lines.refuse(words.front(),
                 fmt::format("{} fields in a row; allowed: t1 t2 x y z roll pitch yaw, or EDGE2 i j x y yaw and six "
                             "numbers, which may be missing",
                             words.size()));
  std::array<double, kFields.size()> row{};
  for (std::size_t i = 0; i < row.size(); ++i) row[i] = lines.number_of(words[i], kFields[i]);
  for (const std::size_t i : {4U, 5U, 6U})
    if (std::abs(row[i]) > kInPlane)
      lines.refuse(words[i], fmt::format("{} is {}; allowed: 0, a motion of the plane", kFields[i], row[i]));
  return {scans.at(row[0]), scans.at(row[1]), Pose2(row[2], row[3], yaw_of(lines, words[7]))};
}

/// An edge of a graph log.
Row edge_row(const LogLines& lines, const std::vector<std::string_view>& words, const Scans& scans) {
  if (words.size() != 6 && words.size() != 12)
    lines.refuse(words.front(), fmt::format("an EDGE2 row of {} words; allowed: EDGE2 i j x y yaw, and six numbers, "
                                            "which may be missing",
                                            words.size()));
  const auto scan = [&](std::string_view word) {
    const auto number = parse_integer(word);
    if (!number || *number < 0 || static_cast<std::size_t>(*number) >= scans.count())
      lines.refuse(word, fmt::format("{} is not a scan of the log; allowed: 0 to {}", quoted_excerpt(word),
                                     static_cast<long long>(scans.count()) - 1));
    return static_cast<std::size_t>(*number);
  };
  const Pose2 motion(lines.number_of(words[3], "x"), lines.number_of(words[4], "y"), yaw_of(lines, words[5]));
  return {scan(words[1]), scan(words[2]), motion};
}

bool in_capitals(std::string_view word) {
  const auto capital = [](char c) { return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_'; };
  return word.front() >= 'A' && word.front() <= 'Z' && std::ranges::all_of(word, capital);
}

}  // namespace

std::vector<PoseRelation> parse_relations(std::string_view text, const std::string& file, const RelatedScans& scans,
                                          const Pose2& robot_from_sensor) {
  std::vector<PoseRelation> relations;
  std::size_t rows = 0;
  in_file(file, {}, [&] {
    const Scans of_log(scans);
    LogLines lines(text);
    std::vector<std::string_view> words;
    while (lines.next()) {
      split_words(lines.line().substr(0, lines.line().find('#')), words);
      if (words.empty()) continue;
      const bool is_edge = words[0] == "EDGE2";
      if (!is_edge && in_capitals(words[0])) continue;
      const Row row = is_edge ? edge_row(lines, words, of_log) : stamped_row(lines, words, of_log);
      ++rows;
      if (!row.first || !row.second) continue;
      const Pose2 motion = robot_from_sensor.inverse() * row.robot_motion * robot_from_sensor;
      if (const auto relation = of_log.between_frames(*row.first, *row.second, motion)) relations.push_back(*relation);
    }
  });
  if (relations.empty())
    throw ConfigError(
        fmt::format("{}: none of its {} relations is between two scans of the log; allowed: stamps of the log, to 1 "
                    "ms, or EDGE2 and the numbers of scans",
                    file, rows));
  return relations;
}

std::vector<PoseRelation> read_relations(const std::filesystem::path& path, const RelatedScans& scans,
                                         const Pose2& robot_from_sensor) {
  constexpr std::uint64_t kMostBytes = std::uint64_t{64} << 20;
  return parse_relations(read_text_file(path, kMostBytes, "relations as text, plain or gzip"), path.string(), scans,
                         robot_from_sensor);
}

}  // namespace scanbench::io
