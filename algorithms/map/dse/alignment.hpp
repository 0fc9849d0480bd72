// Aligns a scan with the map near it: by the end points of its segments, as the paper does, or by a registered matcher.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "algorithms/map/dse/end_point_pairs.hpp"
#include "algorithms/map/dse/strokes.hpp"
#include "algorithms/map/parts/registration.hpp"
#include "core/modules.hpp"

namespace scanbench::mapping::dse {

class MapAligner {
 public:
  /// `method`: "end_points", "none" (a scan stays where it is predicted) or the name of a registered matcher. Throws
  /// ParamError for any other name.
  MapAligner(std::string method, const CorrespondenceRule& correspondence, const RegistrationRule& registration);

  /// `scan`: the observation's segments, sensor frame; `near`: strokes of the map about the prediction. A matcher gets
  /// what the scanner would see of `near` from the predicted pose as its reference.
  Registration align(const Observation& observation, std::span<const Stroke> scan, std::span<const Stroke> near,
                     const Pose2& predicted) const;

  /// What a status other than `converged` means.
  std::string explained(const Registration& registration) const;

 private:
  Registration by_matcher(const Observation& observation, std::span<const Stroke> near, const Pose2& predicted) const;

  std::string method_;
  CorrespondenceRule correspondence_;
  RegistrationRule registration_;
  std::shared_ptr<const ScanMatcher> matcher_;
};

}  // namespace scanbench::mapping::dse
