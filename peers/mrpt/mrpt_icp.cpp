// mrpt_icp: mrpt::slam::CICP of MRPT as a scan matcher, classic or Levenberg-Marquardt.
//
// Parameters have MRPT's defaults. The variance of the points, by which MRPT scales its covariance, comes from the data
// sheet. MRPT gives a share of paired points and a number of iterations, from which the status follows; it does not say
// that a motion is open.
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/poses/CPosePDFGaussian.h>
#include <mrpt/slam/CICP.h>
#include <mrpt/version.h>

#include <cmath>
#include <string>

#include <Eigen/Eigenvalues>

#include "core/modules.hpp"
#include "core/registry.hpp"

namespace scanbench {
namespace {

/// "2.5.8" of 0x258.
std::string mrpt_version() {
  return std::to_string(MRPT_VERSION >> 8) + "." + std::to_string((MRPT_VERSION >> 4) & 15) + "." +
         std::to_string(MRPT_VERSION & 15);
}

mrpt::maps::CSimplePointsMap points_map(const ScanPoints& points) {
  mrpt::maps::CSimplePointsMap map;
  map.reserve(points.size());
  for (const Vec2& p : points.points) map.insertPoint(static_cast<float>(p.x()), static_cast<float>(p.y()), 0.0F);
  return map;
}

double mean_variance(const Scan& scan, const ScanPoints& points) {
  double sum = 0.0;
  for (const Vec2& p : points.points) sum += std::pow(scan.sensor.noise.range_sigma(p.norm()), 2);
  return sum / static_cast<double>(points.size());
}

/// MRPT's covariance if it is one, and zero, "not estimated", otherwise.
Eigen::Matrix3d checked_covariance(const Eigen::Matrix3d& given) {
  const Eigen::Matrix3d c = 0.5 * (given + given.transpose());
  if (!c.allFinite()) return Eigen::Matrix3d::Zero();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(c, Eigen::EigenvaluesOnly);
  return solver.eigenvalues().minCoeff() > 0 ? c : Eigen::Matrix3d::Zero();
}

class MrptIcp final : public ScanMatcher {
 public:
  struct Params {
    mrpt::slam::TICPAlgorithm algorithm = mrpt::slam::icpClassic;
    int max_iterations = 40;
    double threshold_m = 0.75;
    double smallest_threshold_m = 0.1;
    int decimation = 5;
    double min_goodness = 0.3;
    static auto fields() {
      return std::tuple{
          choice("algorithm", &Params::algorithm,
                 {{mrpt::slam::icpClassic, "classic"}, {mrpt::slam::icpLevenbergMarquardt, "levenberg_marquardt"}},
                 "ICP_algorithm"),
          field("max_iterations", &Params::max_iterations, between(1, 1e6), "", "maxIterations"),
          field("threshold_m", &Params::threshold_m, above(0), "m", "thresholdDist: farthest partner at the start"),
          field("smallest_threshold_m", &Params::smallest_threshold_m, above(0), "m",
                "smallestThresholdDist: the threshold at which iterations end"),
          field("decimation", &Params::decimation, between(1, 1e6), "", "corresponding_points_decimation"),
          field("min_goodness", &Params::min_goodness, between(0, 1), "",
                "smallest share of points with a partner; below it there is no match (not a parameter of MRPT)")};
    }
  };
  explicit MrptIcp(const Params& params) : params_(params) {}

  Match match(const Observation& reference, const Observation& current, const Pose2& guess,
              Trace& trace) const override {
    trace.stage(Stage::pre);
    const ScanPoints seen = valid_points(reference.scan), now = valid_points(current.scan);
    if (seen.size() < kFewestPoints || now.size() < kFewestPoints) return {Status::no_match, guess};
    const mrpt::maps::CSimplePointsMap seen_map = points_map(seen), now_map = points_map(now);
    trace.stage(Stage::iterate);
    mrpt::slam::CICP icp(options(mean_variance(current.scan, now)));
    mrpt::slam::CICP::TReturnInfo info;
    const mrpt::poses::CPosePDFGaussian start(mrpt::poses::CPose2D(guess.x(), guess.y(), guess.yaw()));
    const auto pdf = icp.AlignPDF(&seen_map, &now_map, start, info);
    const auto [covariance, mean] = pdf->getCovarianceAndMean();
    const Pose2 pose(mean.x(), mean.y(), mean.phi());
    if (!std::isfinite(pose.x() + pose.y() + pose.yaw()) || info.nIterations == 0 ||
        info.goodness < params_.min_goodness)
      return {Status::no_match, guess};
    const bool ended = info.nIterations < static_cast<unsigned>(params_.max_iterations);
    return {ended ? Status::converged : Status::max_iterations, pose, checked_covariance(covariance.asEigen())};
  }

 private:
  static constexpr std::size_t kFewestPoints = 3;

  mrpt::slam::CICP::TConfigParams options(double variance) const {
    mrpt::slam::CICP::TConfigParams options;
    options.ICP_algorithm = params_.algorithm;
    options.maxIterations = static_cast<unsigned>(params_.max_iterations);
    options.thresholdDist = params_.threshold_m;
    options.smallestThresholdDist = params_.smallest_threshold_m;
    options.corresponding_points_decimation = static_cast<std::uint32_t>(params_.decimation);
    options.covariance_varPoints = variance;
    return options;
  }

  Params params_;
};

SCANBENCH_REGISTER(ScanMatcher, MrptIcp,
                   {.name = "mrpt_icp",
                    .summary = "mrpt::slam::CICP of MRPT " + mrpt_version() + ": ICP with a threshold that shrinks",
                    .reference = "MRPT " + mrpt_version() +
                                 ", mrpt-slam; Martinez, Gonzalez, Morales & Mandow 2006, J. Field Robotics"});

}  // namespace
}  // namespace scanbench
