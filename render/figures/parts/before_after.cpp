// Collects the lines given to a merger and its map.
#include "render/figures/parts/before_after.hpp"
#include "render/figures/parts/frames.hpp"
#include "render/figures/parts/style.hpp"

#include <algorithm>

namespace scanbench::render {

std::size_t BeforeAfter::given_count() const {
  std::size_t n = 0;
  for (const auto& frame : given) n += frame.size();
  return n;
}

std::vector<Segment> BeforeAfter::all_given() const {
  std::vector<Segment> all;
  for (const auto& frame : given) all.insert(all.end(), frame.begin(), frame.end());
  return all;
}

BeforeAfter before_after(const FigureInput& input, const std::string& pipeline) {
  BeforeAfter both;
  const auto choose = [&](auto&& fits) {
    const auto found = std::ranges::find_if(input.results, fits);
    if (both.named == nullptr && found != input.results.end()) both.named = &*found;
  };
  if (!pipeline.empty()) {
    choose([&](const NamedResult& r) { return shows(pipeline, r.pipeline); });
  } else {
    choose([](const NamedResult& r) { return r.result->has_map; });
    choose([](const NamedResult&) { return true; });
  }
  if (both.named == nullptr) return both;
  const PipelineResult& result = *both.named->result;
  both.world_from_sensor = place_frames(input.recording, &result).world_from_sensor;
  both.given.resize(both.world_from_sensor.size());
  for (std::size_t f = 0; f < both.given.size() && f < result.lines.size(); ++f)
    for (const LineFeature& line : result.lines[f].lines)
      both.given[f].push_back(both.world_from_sensor[f] * line.segment);
  for (const MapLine& line : result.map.lines) both.map.push_back(line.segment);
  return both;
}

}  // namespace scanbench::render
