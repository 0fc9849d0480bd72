// pcl_ndt: pcl::NormalDistributionsTransform of PCL as a scan matcher, on points of height zero.
//
// Parameters have PCL's defaults. Of the motion in space that PCL finds, the part in the plane is kept. PCL also has
// NormalDistributionsTransform2D; its plain Newton steps go metres astray between many scans, from any start. PCL gives
// no covariance and does not say that a motion is open.
#include <pcl/pcl_config.h>
#include <pcl/registration/ndt.h>

#include "core/modules.hpp"
#include "core/registry.hpp"
#include "point_cloud.hpp"

namespace scanbench {
namespace {

class PclNdt final : public ScanMatcher {
 public:
  struct Params {
    double resolution_m = 1.0;
    double step_m = 0.1;
    double outlier_ratio = 0.55;
    int max_iterations = 35;
    double epsilon_m2 = 0.1;
    static auto fields() {
      return std::tuple{
          field("resolution_m", &Params::resolution_m, between(0.05, 100), "m", "setResolution: width of a cell"),
          field("step_m", &Params::step_m, between(1e-4, 100), "m", "setStepSize: longest step of the line search"),
          field("outlier_ratio", &Params::outlier_ratio, between(0.01, 0.99), "", "setOulierRatio"),
          field("max_iterations", &Params::max_iterations, between(1, 1e6), "", "setMaximumIterations"),
          field("epsilon_m2", &Params::epsilon_m2, above(0), "m^2",
                "setTransformationEpsilon: squared shift of a step at which iterations end")};
    }
  };
  explicit PclNdt(const Params& params) : params_(params) {}

  Match match(const Observation& reference, const Observation& current, const Pose2& guess,
              Trace& trace) const override {
    trace.stage(Stage::pre);
    const PclCloud::Ptr seen = pcl_cloud(reference.scan), now = pcl_cloud(current.scan);
    if (seen->size() < kFewestPoints || now->size() < kFewestPoints) return {Status::no_match, guess};
    trace.stage(Stage::iterate);
    pcl::NormalDistributionsTransform<pcl::PointXYZ, pcl::PointXYZ> ndt;
    ndt.setResolution(static_cast<float>(params_.resolution_m));
    ndt.setStepSize(params_.step_m);
    ndt.setOulierRatio(params_.outlier_ratio);
    ndt.setMaximumIterations(params_.max_iterations);
    ndt.setTransformationEpsilon(params_.epsilon_m2);
    ndt.setInputTarget(seen);
    ndt.setInputSource(now);
    PclCloud aligned;
    ndt.align(aligned, pcl_transform(guess));
    const Eigen::Matrix4f found = ndt.getFinalTransformation();
    if (!ndt.hasConverged() || !found.allFinite()) return {Status::no_match, guess};
    const bool ended = ndt.getFinalNumIteration() < params_.max_iterations;
    return {ended ? Status::converged : Status::max_iterations, pose_of(found)};
  }

 private:
  Params params_;
};

SCANBENCH_REGISTER(ScanMatcher, PclNdt,
                   {.name = "pcl_ndt",
                    .summary = "pcl::NormalDistributionsTransform of PCL " PCL_VERSION_PRETTY ", in the plane",
                    .reference = "PCL " PCL_VERSION_PRETTY ", registration; Magnusson 2009, Orebro University"});

}  // namespace
}  // namespace scanbench
