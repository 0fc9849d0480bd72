// A box of 3-D data in parallel projection, drawn with the items of a panel: the same picture as PNG, SVG and PDF.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "render/scene.hpp"

namespace scanbench::render {

using Vec3 = Eigen::Vector3d;

/// One axis of the box.
struct Axis3 {
  std::string label{};  ///< with its unit: "x [m]"
  double low = 0.0;
  double high = 1.0;                                    ///< > low
  std::vector<std::pair<double, std::string>> ticks{};  ///< absent: round numbers
};

/// x and y have the same scale, the height is chosen for the eye. The camera looks at the box from above.
class View3 {
 public:
  struct Camera {
    double azimuth_deg = -60.0;  ///< of the camera: 0 on the side of large x, 90 on that of large y
    double elevation_deg = 24.0;
    double height = 0.85;  ///< of the box, relative to the longer one of its x and y sides
  };
  View3(std::array<Axis3, 3> axes, const Camera& camera);

  /// The point on the panel, in arbitrary units; x right, y up.
  Vec2 project(const Vec3& p) const;
  /// Nearness to the camera: 0 at the farthest corner of the box, 1 at the nearest.
  double nearness(const Vec3& p) const;

  /// A panel of about the given width that holds the box: floor and far walls with their grids, axes with ticks and
  /// labels, which have their room in a narrower one too. Items pushed later are in front of it.
  Panel panel(double width_pt, double font_pt) const;

 private:
  Vec3 unit(const Vec3& p) const;  // data to box
  Vec3 corner(const std::array<bool, 3>& high) const;
  void add_wall(int normal, bool high, Panel& panel) const;
  void add_axis(int axis, std::array<bool, 3> at, double pt, double font_pt, Panel& panel) const;
  std::vector<std::pair<double, std::string>> ticks(int axis) const;

  std::array<Axis3, 3> axes_;
  Vec3 scale_;
  Vec3 right_, up_, toward_;
};

/// Points from far to near, in slices of one shade: the farther, the paler.
void add_points_by_depth(const View3& view, std::span<const Vec3> points, const Points& style, Panel& panel);

}  // namespace scanbench::render
