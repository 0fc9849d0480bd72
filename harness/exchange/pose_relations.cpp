// Rows of a relation file, looked up among the stamps of a log.
#include "harness/exchange/pose_relations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <optional>
#include <utility>

#include "core/error.hpp"
#include "harness/exchange/log_builder.hpp"
#include "harness/files/placed_error.hpp"
#include "harness/files/text_file.hpp"

namespace scanbench::harness {
namespace {

constexpr double kSameStamp_s = 1e-3;
constexpr double kInPlane = 1e-6;    // m and rad
constexpr double kLargestYaw = 1e5;  // rad; beyond it sine and cosine have no meaning
constexpr std::array<std::string_view, 8> kFields = {"t1", "t2", "x", "y", "z", "roll", "pitch", "yaw"};

/// Frames by their stamps, which a log need not have in order.
class Stamps {
 public:
  explicit Stamps(std::span<const double> stamps_s) {
    for (std::size_t k = 0; k < stamps_s.size(); ++k) sorted_.emplace_back(stamps_s[k], static_cast<int>(k));
    std::ranges::sort(sorted_);
  }
  std::optional<int> frame_at(double stamp_s) const {
    const auto behind = std::ranges::lower_bound(sorted_, stamp_s, {}, &Stamped::first);
    std::optional<int> nearest;
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

 private:
  using Stamped = std::pair<double, int>;
  std::vector<Stamped> sorted_;
};

using Row = std::array<double, kFields.size()>;

Row read_row(const LogLines& lines, const std::vector<std::string_view>& words) {
  if (words.size() != kFields.size())
    lines.refuse(words.front(), fmt::format("{} fields in a row; allowed: t1 t2 x y z roll pitch yaw", words.size()));
  Row row{};
  for (std::size_t i = 0; i < row.size(); ++i) row[i] = lines.number_of(words[i], kFields[i]);
  for (const std::size_t i : {4, 5, 6})
    if (std::abs(row[i]) > kInPlane)
      lines.refuse(words[i], fmt::format("{} is {}; allowed: 0, a motion of the plane", kFields[i], row[i]));
  if (std::abs(row[7]) > kLargestYaw) lines.refuse(words[7], fmt::format("yaw is {}; allowed: up to 1e5 rad", row[7]));
  return row;
}

}  // namespace

std::vector<PoseRelation> parse_relations(std::string_view text, const std::string& file,
                                          std::span<const double> stamps_s, const Pose2& robot_from_sensor) {
  std::vector<PoseRelation> relations;
  std::size_t rows = 0;
  in_file(file, {}, [&] {
    const Stamps stamps(stamps_s);
    LogLines lines(text);
    std::vector<std::string_view> words;
    while (lines.next()) {
      split_words(lines.line().substr(0, lines.line().find('#')), words);
      if (words.empty()) continue;
      const Row row = read_row(lines, words);
      ++rows;
      const auto first = stamps.frame_at(row[0]), second = stamps.frame_at(row[1]);
      if (!first || !second) continue;
      const Pose2 moved(row[2], row[3], row[7]);
      relations.push_back({*first, *second, robot_from_sensor.inverse() * moved * robot_from_sensor});
    }
  });
  if (relations.empty())
    throw ConfigError(
        fmt::format("{}: none of its {} relations is between two scans of the log; allowed: stamps of the log, to 1 ms",
                    file, rows));
  return relations;
}

std::vector<PoseRelation> read_relations(const std::filesystem::path& path, std::span<const double> stamps_s,
                                         const Pose2& robot_from_sensor) {
  constexpr std::uint64_t kMostBytes = std::uint64_t{64} << 20;
  return parse_relations(read_text_file(path, kMostBytes, "relations as text, plain or gzip"), path.string(), stamps_s,
                         robot_from_sensor);
}

}  // namespace scanbench::harness
