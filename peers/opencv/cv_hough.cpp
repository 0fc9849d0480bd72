// cv_hough: cv::HoughLinesPointSet of OpenCV as a line extractor.
//
// OpenCV gives infinite lines with their votes, most votes first, and often several for one wall. What follows is not
// OpenCV's. Every line takes the points near it that no earlier line took, and is fitted to them by orthogonal least
// squares. Its points within the noise are split where neighbours in scan order are farther apart than max_gap_m; the
// stretches that are long enough are fitted again and become lines. A stretch less than twice as long as the band of
// its line is wide is part of a wall that the line crosses.
#include <algorithm>
#include <cmath>
#include <opencv2/core/version.hpp>
#include <opencv2/imgproc.hpp>

#include "core/geometry/least_squares.hpp"
#include "core/index.hpp"
#include "core/modules.hpp"
#include "core/registry.hpp"

namespace scanbench {
namespace {

/// Indices into the points of a scan, ascending.
using Stretch = std::vector<int>;

class CvHough final : public LineExtractor {
 public:
  struct Params {
    double rho_step_m = 0.03;
    int angles = 180;
    int max_lines = 100;
    double sigmas = 3.0;
    double floor_m = 0.01;
    double max_gap_m = 0.3;
    int min_points = 8;
    double min_length_m = 0.1;

    static auto fields() {
      return std::tuple{
          field("rho_step_m", &Params::rho_step_m, between(1e-3, 10), "m",
                "OpenCV's rho_step: distance between cells; increased if a range would need more than 4096 cells"),
          field("angles", &Params::angles, between(4, 1440), "", "directions over half a turn; OpenCV's theta_step"),
          field("max_lines", &Params::max_lines, between(1, 10000), "", "OpenCV's lines_max"),
          field("sigmas", &Params::sigmas, between(0, 100), "",
                "farthest point of a line, in standard deviations of the range noise"),
          field("floor_m", &Params::floor_m, between(0, 10), "m", "smallest tolerance"),
          field("max_gap_m", &Params::max_gap_m, above(0), "m", "longest gap between neighbouring points of a line"),
          field("min_points", &Params::min_points, between(2, 1e6), "",
                "fewest points of a line, and OpenCV's threshold of votes"),
          field("min_length_m", &Params::min_length_m, at_least(0), "m", "shortest line")};
    }
  };

  explicit CvHough(const Params& params) : params_(params) {}

  ScanLines extract(const Scan& scan, Trace& trace) const override {
    trace.stage(Stage::pre);
    const ScanPoints points = valid_points(scan);
    std::vector<double> tolerance;
    for (const Vec2& p : points.points)
      tolerance.push_back(std::max(params_.floor_m, params_.sigmas * scan.sensor.noise.range_sigma(p.norm())));
    trace.stage(Stage::segment);
    const double rho_step = step_for(points);
    const std::vector<cv::Vec3d> voted = voted_lines(points, rho_step);
    trace.stage(Stage::post);
    std::vector<bool> taken(points.size(), false);
    std::vector<LineFeature> lines;
    std::vector<int> owner(points.size(), -1);
    for (const cv::Vec3d& line : voted) {
      const Vec2 normal(std::cos(line[2]), std::sin(line[2]));
      const Stretch near = points_near(points, taken, normal, line[1], [&](std::size_t i) {
        return tolerance[i] + 0.5 * rho_step + points.points[i].norm() * kPi / (2.0 * params_.angles);
      });
      const LineFit fit = fitted(points, near);
      if (fit.degenerate) continue;
      const Stretch on_line =
          points_near(points, taken, fit.normal, fit.offset, [&](std::size_t i) { return tolerance[i]; });
      for (const Stretch& stretch : stretches(points, on_line)) {
        const LineFit refit = fitted(points, stretch);
        if (!is_wall(points, tolerance, stretch, fit, refit)) continue;
        for (const int i : stretch) {
          taken[as_index(i)] = true;
          owner[as_index(i)] = static_cast<int>(lines.size());
        }
        lines.push_back(feature(points, stretch, refit));
      }
    }
    return in_scan_order(scan, points, std::move(lines), owner);
  }

 private:
  static constexpr int kMostCells = 4096;

  double step_for(const ScanPoints& points) const {
    double reach = 0.0;
    for (const Vec2& p : points.points) reach = std::max(reach, p.norm());
    return std::max(params_.rho_step_m, 2.0 * reach / kMostCells);
  }

  /// (votes, rho, theta) of the lines that OpenCV finds, most votes first.
  std::vector<cv::Vec3d> voted_lines(const ScanPoints& points, double rho_step) const {
    std::vector<cv::Vec3d> lines;
    if (static_cast<int>(points.size()) < params_.min_points) return lines;
    std::vector<cv::Point2f> floats;
    double reach = rho_step;
    for (const Vec2& p : points.points) {
      floats.emplace_back(static_cast<float>(p.x()), static_cast<float>(p.y()));
      reach = std::max(reach, p.norm());
    }
    // OpenCV returns lines with more votes than the threshold, and neighbouring cells share the votes of a noisy wall.
    cv::HoughLinesPointSet(floats, lines, params_.max_lines, params_.min_points - 1, -reach, reach, rho_step, 0.0, kPi,
                           kPi / params_.angles);
    return lines;
  }

  /// The free points within a band of a line.
  template <class Tolerance>
  static Stretch points_near(const ScanPoints& points, const std::vector<bool>& taken, const Vec2& normal,
                             double offset, Tolerance&& tolerance) {
    Stretch near;
    for (std::size_t i = 0; i < points.size(); ++i)
      if (!taken[i] && std::fabs(normal.dot(points.points[i]) - offset) <= tolerance(i))
        near.push_back(static_cast<int>(i));
    return near;
  }

  static LineFit fitted(const ScanPoints& points, const Stretch& stretch) {
    std::vector<Vec2> chosen;
    for (const int i : stretch) chosen.push_back(points.points[as_index(i)]);
    return fit_line(chosen);
  }

  std::vector<Stretch> stretches(const ScanPoints& points, const Stretch& near) const {
    std::vector<Stretch> parts;
    for (const int i : near) {
      const bool continues =
          !parts.empty() &&
          (points.points[as_index(i)] - points.points[as_index(parts.back().back())]).norm() <= params_.max_gap_m;
      if (!continues) parts.emplace_back();
      parts.back().push_back(i);
    }
    return parts;
  }

  bool is_wall(const ScanPoints& points, const std::vector<double>& tolerance, const Stretch& stretch,
               const LineFit& line, const LineFit& refit) const {
    if (static_cast<int>(stretch.size()) < params_.min_points || refit.degenerate) return false;
    double band = 0.0, low = kInf, high = -kInf;
    for (const int i : stretch) {
      band = std::max(band, 2.0 * tolerance[as_index(i)]);
      const double along = perpendicular(line.normal).dot(points.points[as_index(i)]);
      low = std::min(low, along);
      high = std::max(high, along);
    }
    return high - low >= std::max(params_.min_length_m, 2.0 * band);
  }

  static LineFeature feature(const ScanPoints& points, const Stretch& stretch, const LineFit& fit) {
    LineFeature line;
    line.segment = seen_from_origin(fit.project(points.points[as_index(stretch.front())]),
                                    fit.project(points.points[as_index(stretch.back())]));
    line.line = fit.polar();
    line.first_beam = points.beams[as_index(stretch.front())];
    line.last_beam = points.beams[as_index(stretch.back())];
    line.points = static_cast<int>(stretch.size());
    line.rms_m = fit.rms();
    return line;
  }

  static ScanLines in_scan_order(const Scan& scan, const ScanPoints& points, std::vector<LineFeature> lines,
                                 const std::vector<int>& owner) {
    std::vector<int> order(lines.size()), rank(lines.size());
    for (std::size_t k = 0; k < order.size(); ++k) order[k] = static_cast<int>(k);
    std::ranges::sort(order, {}, [&](int k) { return lines[as_index(k)].first_beam; });
    ScanLines result{{}, std::vector<int>(as_index(scan.beams()), -1)};
    for (const int k : order) {
      rank[as_index(k)] = static_cast<int>(result.lines.size());
      result.lines.push_back(lines[as_index(k)]);
    }
    for (std::size_t i = 0; i < owner.size(); ++i)
      if (owner[i] >= 0) result.labels[as_index(points.beams[i])] = rank[as_index(owner[i])];
    return result;
  }

  Params params_;
};

SCANBENCH_REGISTER(LineExtractor, CvHough,
                   {.name = "cv_hough",
                    .summary = "cv::HoughLinesPointSet of OpenCV " CV_VERSION ", its lines split into segments at gaps",
                    .reference = "OpenCV " CV_VERSION ", module imgproc; the segments are ours"});

}  // namespace
}  // namespace scanbench
