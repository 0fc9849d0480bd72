// The three predictions of a pose.
#include "algorithms/map/parts/prediction.hpp"

#include <cmath>

namespace scanbench::mapping {
namespace {

bool finite(const Pose2& pose) {
  return pose.translation().allFinite() && std::isfinite(pose.cos()) && std::isfinite(pose.sin());
}

}  // namespace

Prediction::Expected Prediction::next(const Pose2& given, double stamp_s) {
  now_ = {.given = finite(given) ? std::optional(given) : std::nullopt, .stamp_s = stamp_s, .found = {}};
  if (!last_) return {};
  Expected expected{.map_from_sensor = last_->found, .remark = {}};
  if (kind_ == PredictionKind::odometry) {
    if (now_.given && last_->given)
      expected.map_from_sensor = last_->found * (last_->given->inverse() * *now_.given);
    else
      expected.remark = "the given pose is not finite";
  } else if (kind_ == PredictionKind::constant_velocity && before_) {
    const double passed = stamp_s - last_->stamp_s, before = last_->stamp_s - before_->stamp_s;
    if (passed == 0 && before == 0)  // no stamps: equal steps
      expected.map_from_sensor = last_->found * (before_->found.inverse() * last_->found);
    else if (passed > 0 && before > 0)
      expected.map_from_sensor =
          last_->found * Pose2::exp(passed / before * (before_->found.inverse() * last_->found).log());
  }
  if (stamp_s < last_->stamp_s) expected.remark = "time runs backwards";
  return expected;
}

void Prediction::found(const Pose2& map_from_sensor) {
  now_.found = map_from_sensor;
  before_ = last_;
  last_ = now_;
}

}  // namespace scanbench::mapping
