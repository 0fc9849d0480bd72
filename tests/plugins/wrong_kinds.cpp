// A good and a wrong module of each kind other than line extractors, for the conformance checks.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "core/modules.hpp"
#include "core/registry.hpp"

namespace scanbench {
namespace {

bool has_return(const Scan& scan) {
  for (int beam = 0; beam < scan.beams(); ++beam)
    if (scan.valid(beam)) return true;
  return false;
}

/// Believes the guess. Wrong: also of scans without returns, and of all others.
class Believes final : public ScanMatcher {
 public:
  using Params = NoParams;
  explicit Believes(Params) {}
  Match match(const Observation&, const Observation&, const Pose2& guess, Trace&) const override {
    return {Status::converged, guess};
  }
};

enum class Fault { none, some };

/// Leaves the poses as they are. Wrong: without the last one.
template <Fault kFault>
class Leaves final : public Aligner {
 public:
  using Params = NoParams;
  explicit Leaves(Params) {}
  Alignment align(std::span<const Observation> scans, std::span<const Pose2> initial, Trace&) const override {
    const bool seen = std::ranges::any_of(scans, [](const Observation& o) { return has_return(o.scan); });
    Alignment result{seen ? Status::converged : Status::no_match, {initial.begin(), initial.end()}};
    if (kFault == Fault::some && !result.world_from_sensor.empty()) result.world_from_sensor.pop_back();
    return result;
  }
};

int drift = 0;  // what a module must not have: a state of all instances

/// Collects all lines at the guessed poses. Wrong: a little farther with every line that any instance has seen.
template <Fault kFault>
class Collects final : public Mapper {
 public:
  using Params = NoParams;
  explicit Collects(Params) {}
  Insertion insert(const Observation& observation, const Pose2& guess, Trace&) override {
    const std::size_t before = map_.lines.size();
    for (const LineFeature& line : observation.lines.lines) {
      const Segment segment = guess * line.segment;
      if (!(segment.length() > 0 && std::isfinite(segment.length()))) continue;
      MapLine added;
      added.segment = segment;
      if (kFault == Fault::some) added.segment.a.x() += 1e-9 * ++drift;
      added.points = line.points;
      map_.lines.push_back(added);
    }
    const int lines = static_cast<int>(map_.lines.size());
    if (map_.lines.size() == before) return {Status::no_match, guess, lines, "no lines"};
    return {Status::converged, guess, lines};
  }
  LineMap map() const override { return map_; }

 private:
  LineMap map_;
};

/// Segments whose ends are near those of the first one of a cluster become one, their mean. Wrong: the first one.
template <Fault kFault>
class Unites final : public SegmentMerger {
 public:
  using Params = NoParams;
  explicit Unites(Params) {}
  MergeResult merge(const MergeInput& input, Trace&) const override {
    MergeResult result{.map = {}, .labels = {}, .cluster1 = {}, .cluster2 = {}};
    std::vector<Segment> first;
    for (const MapLine& line : input.lines) {
      const Segment& s = line.segment;
      result.labels.push_back(-1);
      if (!s.a.allFinite() || !s.b.allFinite()) continue;
      std::size_t k = 0;
      while (k < first.size() && (first[k].a - s.a).norm() + (first[k].b - s.b).norm() > 0.5) ++k;
      result.labels.back() = static_cast<int>(k);
      if (k == first.size()) {
        first.push_back(s);
        result.map.lines.push_back({.segment = s, .points = line.points});
        continue;
      }
      MapLine& united = result.map.lines[k];
      ++united.members;
      united.points += line.points;
      if (kFault == Fault::some) continue;
      united.segment.a += (s.a - united.segment.a) / united.members;
      united.segment.b += (s.b - united.segment.b) / united.members;
    }
    return result;
  }
};

template <class Interface, class Module>
bool add(const char* name) {
  return Registry<Interface>::template add<Module>({.name = name, .summary = "for the checks", .reference = "none"});
}

const bool registered =
    add<ScanMatcher, Believes>("believes") && add<Aligner, Leaves<Fault::none>>("leaves") &&
    add<Aligner, Leaves<Fault::some>>("leaves_one_out") && add<Mapper, Collects<Fault::none>>("collects") &&
    add<Mapper, Collects<Fault::some>>("drifts") && add<SegmentMerger, Unites<Fault::none>>("unites") &&
    add<SegmentMerger, Unites<Fault::some>>("keeps_the_first");

}  // namespace
}  // namespace scanbench
