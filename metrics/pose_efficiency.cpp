// pose_efficiency: how near matched poses come to the best that the two scans allow, and whether a matcher knows how
// good it is. Two Cramer-Rao bounds: walls known (Censi, "On achievable accuracy for range-finder localization", ICRA
// 2007) and walls unknown, as they are to a matcher; the second one is about twice the first in a room (variances).
//
// A pair counts if its scans determine the pose: if the unknown-walls bound allows no motion a standard deviation above
// max_sigma_m. A matcher that gives no pose for such a pair (degenerate, no_match) is not wrong there but mute: those
// pairs are in pose_unmatched and in no error. Gross errors are errors. A ratio below 1 beyond its interval means that
// a matcher uses more than the places of walls: where they end, say.
#include <algorithm>
#include <cmath>

#include <Eigen/LU>

#include "core/distributions.hpp"
#include "core/error.hpp"
#include "core/geometry/pose_errors.hpp"
#include "core/registry.hpp"
#include "metrics/pose_bound.hpp"
#include "metrics/rows.hpp"

namespace scanbench::metrics {
namespace {

constexpr double kLeverM = 3.0;  // metres of motion per radian where motions are compared

/// A match whose true pose the scans determine.
struct ScoredMatch {
  Eigen::Vector3d error;
  Eigen::Matrix3d unknown_walls;  // bounds: covariances
  Eigen::Matrix3d known_map;
};

/// Squared errors and bounds over matches.
struct PosePart {
  Mean squared_error, fourth_power, unknown_walls, known_map;
  void add(double square, double unknown, double known) {
    squared_error.add(square);
    fourth_power.add(square * square);
    unknown_walls.add(unknown);
    known_map.add(known);
  }
  double ratio() const { return squared_error.value() / unknown_walls.value(); }
  double half_width() const {
    const double mean = squared_error.value();
    const auto n = static_cast<double>(squared_error.count());
    return 1.96 * std::sqrt(std::max(fourth_power.value() - mean * mean, 0.0) / (n - 1));
  }
};

constexpr const char* kTable = "pose_errors";  // pose_errors.csv

class PoseEfficiency : public MetricFamily {
 public:
  struct Params {
    double max_sigma_m = 0.25;
    bool errors = false;
    static auto fields() {
      return std::tuple{
          field("max_sigma_m", &Params::max_sigma_m, above(0), "m",
                "largest standard deviation that the bound may leave to a motion of a pair that counts; yaw at 3 m"),
          field("errors", &Params::errors, "write pose_errors.csv: error and bounds of every pair that counts")};
    }
  };
  explicit PoseEfficiency(const Params& params) : params_(params) {}

  std::vector<MetricDescription> describe() const override {
    using enum Direction;
    return {
        {"pose_efficiency", "match MSE / bound", "", lower_is_better, 0.05,
         "geometric mean of pose_efficiency_position and pose_efficiency_heading"},
        {"pose_efficiency_position", "match MSE / bound, position", "", lower_is_better, 0.05,
         "mean squared error of the matched position over its mean Cramer-Rao bound, walls unknown; 1 is the best"},
        {"pose_efficiency_heading", "match MSE / bound, heading", "", lower_is_better, 0.05,
         "mean squared error of the matched heading over its mean Cramer-Rao bound, walls unknown; 1 is the best"},
        {"pose_known_map_position", "MSE / known-map bound, position", "", neither, 0.05,
         "mean squared error of the matched position over its mean bound if the walls were known"},
        {"pose_known_map_heading", "MSE / known-map bound, heading", "", neither, 0.05,
         "mean squared error of the matched heading over its mean bound if the walls were known"},
        {"pose_bound_position", "match bound, position", "m", neither, 0.0,
         "root of the mean bound of the position, walls unknown"},
        {"pose_bound_heading", "match bound, heading", "deg", neither, 0.0,
         "root of the mean bound of the heading, walls unknown"},
        {"pose_error_position", "match error, position", "m", lower_is_better, 0.001,
         "root mean square error of the matched position"},
        {"pose_error_position_max", "largest match error, position", "m", lower_is_better, 0.001,
         "largest error of the matched position"},
        {"pose_error_heading", "match error, heading", "deg", lower_is_better, 0.01,
         "root mean square error of the matched heading"},
        {"pose_nees", "match NEES", "", target, 0.2,
         "mean of e' C^-1 e over matches with a covariance C; honest ones give 3, overconfident ones more; ci: the "
         "band in which it lies with probability 95 % if they are honest",
         false, 3.0},
        share({"pose_unmatched", "pairs without a match", "", lower_is_better, 0.001,
               "share of the pairs that determine a pose for which the matcher has no match or says that a motion is "
               "open"}),
        share({"pose_unobservable", "pairs with an open motion", "", neither, 0.0,
               "share of all pairs that leave a motion open"}),
        share({"pose_open_found", "open motions found", "", higher_is_better, 0.01,
               "share of the pairs that leave a motion open for which the matcher says so"})};
  }

  bool applies(const MetricInput& input) const override {
    return has_beam_truth(input) && !input.result.matches.empty() && input.observed.sensor.noise.range_sigma(1.0) > 0;
  }

  std::vector<MetricRow> evaluate(const MetricInput& input) const override {
    SCANBENCH_ASSERT(applies(input));
    PosePart position, heading;
    Mean nees, unmatched, unobservable, open_found;
    double largest_m = kUndefined;
    for_each_pair(input, [&](const FrameMatch& pair, const ScoredMatch* scored) {
      const Status status = pair.match.status;
      const bool mute = status == Status::degenerate || status == Status::no_match;
      unobservable.add(scored == nullptr ? 1.0 : 0.0);
      if (scored == nullptr) {
        open_found.add(mute ? 1.0 : 0.0);
        return;
      }
      unmatched.add(mute ? 1.0 : 0.0);
      if (mute) return;
      const Eigen::Vector3d& e = scored->error;
      largest_m = std::fmax(largest_m, e.head<2>().norm());
      position.add(e.head<2>().squaredNorm(), scored->unknown_walls.topLeftCorner<2, 2>().trace(),
                   scored->known_map.topLeftCorner<2, 2>().trace());
      heading.add(e.z() * e.z(), scored->unknown_walls(2, 2), scored->known_map(2, 2));
      const Eigen::Matrix3d& c = pair.match.covariance;
      if (c.determinant() > 0) nees.add(e.dot(c.inverse() * e));
    });

    Rows rows(describe());
    rows.add("pose_efficiency", kAll, std::sqrt(position.ratio() * heading.ratio()), position.squared_error.count());
    for (const auto& [name, part] : {std::pair("position", &position), std::pair("heading", &heading)}) {
      const double bound = part->unknown_walls.value();
      const std::int64_t n = part->squared_error.count();
      MetricRow& row = rows.add(std::string("pose_efficiency_") + name, kAll, part->ratio(), n);
      if (row.count > 1) {
        row.ci_low = row.value - part->half_width() / bound;
        row.ci_high = row.value + part->half_width() / bound;
      }
      rows.add(std::string("pose_known_map_") + name, kAll, part->squared_error.value() / part->known_map.value(), n);
    }
    rows.add("pose_bound_position", kAll, position.unknown_walls.root(), position.unknown_walls.count());
    rows.add("pose_bound_heading", kAll, degrees(heading.unknown_walls.root()), heading.unknown_walls.count());
    rows.add("pose_error_position", kAll, position.squared_error.root(), position.squared_error.count());
    rows.add("pose_error_position_max", kAll, largest_m, position.squared_error.count());
    rows.add("pose_error_heading", kAll, degrees(heading.squared_error.root()), heading.squared_error.count());
    MetricRow& row = rows.add("pose_nees", kAll, nees);
    if (row.count > 0) {
      const auto n = static_cast<double>(row.count);
      row.ci_low = chi_square_quantile(0.025, 3.0 * static_cast<double>(row.count)) / n;
      row.ci_high = chi_square_quantile(0.975, 3.0 * static_cast<double>(row.count)) / n;
    }
    rows.add("pose_unmatched", kAll, unmatched);
    rows.add("pose_unobservable", kAll, unobservable);
    rows.add("pose_open_found", kAll, open_found);
    return rows.take();
  }

  std::vector<MetricTable> tables(const MetricInput& input) const override {
    if (!params_.errors) return {};
    MetricTable table{kTable,
                      {"frame", "reference", "x_m", "y_m", "yaw_rad", "bound_position_m", "bound_yaw_rad",
                       "known_map_position_m", "known_map_yaw_rad"},
                      {}};
    for_each_pair(input, [&](const FrameMatch& pair, const ScoredMatch* scored) {
      if (scored == nullptr || pair.match.status == Status::degenerate || pair.match.status == Status::no_match) return;
      const Eigen::Vector3d& e = scored->error;
      table.rows.push_back(
          {static_cast<double>(pair.frame), static_cast<double>(pair.reference), e.x(), e.y(), e.z(),
           std::sqrt(scored->unknown_walls.topLeftCorner<2, 2>().trace()), std::sqrt(scored->unknown_walls(2, 2)),
           std::sqrt(scored->known_map.topLeftCorner<2, 2>().trace()), std::sqrt(scored->known_map(2, 2))});
    });
    return {table};
  }

  std::vector<std::string> table_names() const override { return {kTable}; }

 private:
  /// Calls visit(match, scored); scored is null for a pair that leaves a motion open.
  template <class Visit>
  void for_each_pair(const MetricInput& input, Visit visit) const {
    const Surfaces surfaces = join_walls(input.truth->walls);
    const auto& poses = input.truth->world_from_sensor;
    for (const FrameMatch& pair : input.result.matches) {
      const auto frame = static_cast<std::size_t>(pair.frame), reference = static_cast<std::size_t>(pair.reference);
      const PoseInformation information = pose_information(input, surfaces, reference, frame);
      if (!(weakest_sigma_m(information.unknown_walls, kLeverM) <= params_.max_sigma_m)) {
        visit(pair, nullptr);
        continue;
      }
      const ScoredMatch scored{pose_error(pair.match.reference_from_current, poses[reference].inverse() * poses[frame]),
                               information.unknown_walls.inverse(), information.known_map.inverse()};
      visit(pair, &scored);
    }
  }

  Params params_;
};

SCANBENCH_REGISTER(
    MetricFamily, PoseEfficiency,
    {.name = "pose_efficiency",
     .summary = "errors of matched poses against their Cramer-Rao bounds, and honesty of their covariances",
     .reference = "Censi 2007, On achievable accuracy for range-finder localization, ICRA; Bar-Shalom et al. 2001"});

}  // namespace
}  // namespace scanbench::metrics
