// Scans and poses as PCL has them.
#pragma once

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <cmath>

#include "core/geometry/pose2.hpp"
#include "core/scan.hpp"

namespace scanbench {

using PclCloud = pcl::PointCloud<pcl::PointXYZ>;

/// PCL needs three points for a motion.
inline constexpr std::size_t kFewestPoints = 3;

/// The returns within the sensor's range. A faulty reading of 1e300 m is not a point to PCL, which ends the process.
inline PclCloud::Ptr pcl_cloud(const Scan& scan) {
  PclCloud::Ptr cloud(new PclCloud);
  for (const Vec2& p : valid_points(scan).points)
    if (p.norm() <= scan.sensor.range_max_m)
      cloud->emplace_back(static_cast<float>(p.x()), static_cast<float>(p.y()), 0.0F);
  return cloud;
}

inline Eigen::Matrix4f pcl_transform(const Pose2& pose) {
  Eigen::Matrix4d m = Eigen::Matrix4d::Identity();
  m.topLeftCorner<2, 2>() << pose.cos(), -pose.sin(), pose.sin(), pose.cos();
  m(0, 3) = pose.x();
  m(1, 3) = pose.y();
  return m.cast<float>();
}

inline Pose2 pose_of(const Eigen::Matrix4f& transform) {
  const Eigen::Matrix4d m = transform.cast<double>();
  return {m(0, 3), m(1, 3), std::atan2(m(1, 0), m(0, 0))};
}

}  // namespace scanbench
