// Fills the rows of a metric family and names its subjects.
#include "metrics/rows.hpp"

#include <algorithm>
#include <map>

#include "core/error.hpp"

namespace scanbench::metrics {

MetricRow& Rows::add(std::string_view metric, std::string_view subject, double value, std::int64_t count) {
  const auto found =
      std::ranges::find_if(descriptions_, [&](const MetricDescription& d) { return d.metric == metric; });
  SCANBENCH_ASSERT(found != descriptions_.end());
  const bool defined = std::isfinite(value);
  rows_.push_back({.metric = found->metric,
                   .subject = std::string(subject),
                   .value = defined ? value : kUndefined,
                   .unit = found->unit,
                   .count = defined ? count : 0,
                   .ci_low = std::nullopt,
                   .ci_high = std::nullopt});
  return rows_.back();
}

std::vector<std::string> wall_subjects(std::span<const Wall> walls) {
  std::map<std::string_view, int> uses{{"", 2}, {"mean", 2}, {kAll, 2}};  // subjects with another meaning
  for (const Wall& wall : walls) ++uses[wall.label];
  std::vector<std::string> subjects;
  for (std::size_t i = 0; i < walls.size(); ++i)
    subjects.push_back(uses[walls[i].label] == 1 ? walls[i].label : walls[i].label + "#" + std::to_string(i));
  return subjects;
}

}  // namespace scanbench::metrics
