// pcl_icp: pcl::IterativeClosestPoint of PCL as a scan matcher, with its estimation of plane motions.
//
// Parameters have PCL's defaults, which pair points at any distance and end after ten iterations. PCL gives no
// covariance and does not say that a motion is open.
#include <pcl/pcl_config.h>
#include <pcl/registration/icp.h>
#include <pcl/registration/transformation_estimation_2D.h>

#include "core/modules.hpp"
#include "core/registry.hpp"
#include "point_cloud.hpp"

namespace scanbench {
namespace {

class PclIcp final : public ScanMatcher {
 public:
  struct Params {
    int max_iterations = 10;
    double gate_m = 0.0;
    double epsilon_m2 = 0.0;
    static auto fields() {
      return std::tuple{field("max_iterations", &Params::max_iterations, between(1, 1e6), "", "setMaximumIterations"),
                        field("gate_m", &Params::gate_m, at_least(0), "m",
                              "setMaxCorrespondenceDistance: farthest partner of a point; 0: any"),
                        field("epsilon_m2", &Params::epsilon_m2, at_least(0), "m^2",
                              "setTransformationEpsilon: squared shift of a step at which iterations end; 0: any")};
    }
  };
  explicit PclIcp(const Params& params) : params_(params) {}

  Match match(const Observation& reference, const Observation& current, const Pose2& guess,
              Trace& trace) const override {
    trace.stage(Stage::pre);
    const PclCloud::Ptr seen = pcl_cloud(reference.scan), now = pcl_cloud(current.scan);
    if (seen->size() < kFewestPoints || now->size() < kFewestPoints) return {Status::no_match, guess};
    trace.stage(Stage::iterate);
    pcl::IterativeClosestPoint<pcl::PointXYZ, pcl::PointXYZ> icp;
    icp.setTransformationEstimation(
        pcl::make_shared<pcl::registration::TransformationEstimation2D<pcl::PointXYZ, pcl::PointXYZ>>());
    icp.setMaximumIterations(params_.max_iterations);
    if (params_.gate_m > 0) icp.setMaxCorrespondenceDistance(params_.gate_m);
    if (params_.epsilon_m2 > 0) icp.setTransformationEpsilon(params_.epsilon_m2);
    icp.setInputTarget(seen);
    icp.setInputSource(now);
    PclCloud aligned;
    icp.align(aligned, pcl_transform(guess));
    const Eigen::Matrix4f found = icp.getFinalTransformation();
    if (!icp.hasConverged() || !found.allFinite()) return {Status::no_match, guess};
    using Criteria = pcl::registration::DefaultConvergenceCriteria<float>;
    const bool ended = icp.getConvergeCriteria()->getConvergenceState() != Criteria::CONVERGENCE_CRITERIA_ITERATIONS;
    return {ended ? Status::converged : Status::max_iterations, pose_of(found)};
  }

 private:
  Params params_;
};

SCANBENCH_REGISTER(ScanMatcher, PclIcp,
                   {.name = "pcl_icp",
                    .summary = "pcl::IterativeClosestPoint of PCL " PCL_VERSION_PRETTY
                               ": point-to-point ICP in the plane",
                    .reference = "PCL " PCL_VERSION_PRETTY ", registration; Besl & McKay 1992, PAMI 14(2)"});

}  // namespace
}  // namespace scanbench
