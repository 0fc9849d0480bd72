// Casts scans by sweeping walls over the beams and single rays through the tree; round bodies follow one by one.
#include "sim/cast/exact_caster.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/error.hpp"
#include "core/geometry/angles.hpp"
#include "core/geometry/geometry.hpp"
#include "core/geometry/pose2.hpp"
#include "core/isa.hpp"
#include "core/sensor_model.hpp"
#include "sim/cast/beam_fan.hpp"
#include "sim/cast/box_walk.hpp"
#include "sim/cast/wall_tree.hpp"
#include "sim/lanes/cast_kernels.hpp"
#include "sim/ray_math.hpp"

namespace scanbench::sim {
namespace {

constexpr double kTieM = 1e-9;
// Up to this number, sweeping every wall is faster than a search for the relevant ones (docs/performance.md).
constexpr int kSweepAllWalls = 64;
// Scans of fewer beams are cast ray by ray through the tree.
constexpr int kFewBeams = 4;

// An array of numbers, aligned to a cache line and padded to a multiple of 8.
class LaneArray {
 public:
  LaneArray() = default;
  LaneArray(int count, double value)
      : blocks_(static_cast<std::size_t>(count) / 8, Block{value, value, value, value, value, value, value, value}) {}
  double* data() { return reinterpret_cast<double*>(blocks_.data()); }

 private:
  struct alignas(64) Block {
    double numbers[8];
  };
  std::vector<Block> blocks_;
};

// The beams of one scan and their hits. Constructed once for several scans of a sensor.
class ScanScratch {
 public:
  explicit ScanScratch(const ScanGeometry& beams)
      : beams_(beams),
        padded_((beams.beams() + 7) / 8 * 8),
        sensor_x_(padded_, 0.0),
        sensor_y_(padded_, 0.0),
        dx_(padded_, 0.0),
        dy_(padded_, 0.0),
        range_(padded_, kNoHit),
        surface_(padded_, -1.0) {
    for (int i = 0; i < padded_; ++i) {  // padded_ is 0 without beams
      const Vec2& d = beams.direction(std::min(i, beams.beams() - 1));
      sensor_x_.data()[i] = d.x();
      sensor_y_.data()[i] = d.y();
    }
  }

  /// The sensor's own beams.
  BeamFan aim(const Pose2& pose, const CastKernels& kernels) {
    kernels.rotate(sensor_x_.data(), sensor_y_.data(), pose.cos(), pose.sin(), padded_, dx_.data(), dy_.data());
    return fan(pose, 0.0);
  }

  BeamFan aim(const BentScan& scan) {
    double bend = 0.0;
    for (int i = 0; i < padded_; ++i) {
      const std::size_t beam = static_cast<std::size_t>(std::min(i, beams_.beams() - 1));
      const Vec2& d = scan.directions[beam];
      dx_.data()[i] = d.x();
      dy_.data()[i] = d.y();
      const Vec2 nominal = scan.world_from_sensor.rotate(beams_.direction(static_cast<int>(beam)));
      bend = std::max(bend, nominal.dot(d) > 0 ? 0.5 * kPi * std::fabs(cross(nominal, d)) : kPi);
    }
    return fan(scan.world_from_sensor, bend);
  }

  /// Clears the hits; surfaces beyond `range_max_m` do not count.
  BeamHits clear(double range_max_m, const CastKernels& kernels) {
    const BeamHits hits{range_.data(), surface_.data()};
    kernels.clear(hits, padded_, unhit_range(range_max_m));
    return hits;
  }

 private:
  BeamFan fan(const Pose2& pose, double slack_rad) {
    const double start = beams_.angle_min() + pose.yaw();
    return {.origin_x = pose.x(),
            .origin_y = pose.y(),
            .dx = dx_.data(),
            .dy = dy_.data(),
            .beams = beams_.beams(),
            .padded = padded_,
            .start_rad = std::remainder(start, kTwoPi),
            .step_rad = beams_.angle_step(),
            .slack_rad = slack_rad};
  }

  const ScanGeometry& beams_;
  int padded_;
  LaneArray sensor_x_, sensor_y_, dx_, dy_, range_, surface_;
};

void offer(double range, double surface, int beam, const BeamHits& hits) {
  double& best = hits.range[beam];
  if (range == kNoHit || range > best + kTieM) return;
  double& id = hits.surface[beam];
  id = range < best - kTieM ? surface : std::min(surface, id);
  best = std::min(range, best);
}

// Offers a round body to the beams that it may cover. The angles only select the beams.
void offer_circle(const PlacedCircle& circle, double surface, const BeamFan& fan, const BeamHits& hits) {
  const Vec2 origin(fan.origin_x, fan.origin_y);
  const Vec2 c = circle.center - origin;
  const double distance = c.norm();
  const double period = kTwoPi / std::fabs(fan.step_rad);
  const double margin = (fan.slack_rad + 1e-6) * period / kTwoPi;
  BeamRuns runs{{{0, fan.beams - 1}, {0, -1}}};
  if (distance > circle.radius_m * (1 + 1e-6)) {
    const double half = std::asin(circle.radius_m / distance) / kTwoPi * period + margin;
    const double middle = std::remainder(std::atan2(c.y(), c.x()) - fan.start_rad, kTwoPi) / fan.step_rad;
    runs = beam_runs(middle - half, 2 * half, period, fan.beams);
  }
  for (const BeamRun& run : runs.runs)
    for (int i = run.first; i <= run.last; ++i)
      offer(range_to_circle(origin, {fan.dx[i], fan.dy[i]}, circle.center, circle.radius_m), surface, i, hits);
}

// Segments with the circles' boxes, for a tree.
std::vector<Segment> diagonals(const std::vector<PlacedCircle>& circles) {
  std::vector<Segment> segments;
  for (const PlacedCircle& circle : circles) {
    const Vec2 half = Vec2::Constant(circle.radius_m);
    segments.push_back({circle.center - half, circle.center + half});
  }
  return segments;
}

template <class T>
std::span<T> part(std::span<T> buffer, std::size_t first, std::size_t count) {
  return buffer.empty() ? buffer : buffer.subspan(first, count);
}

HitBuffers part(const HitBuffers& out, std::size_t first, std::size_t count) {
  return {.ranges = part(out.ranges, first, count),
          .wall_ids = part(out.wall_ids, first, count),
          .cos_incidence = part(out.cos_incidence, first, count),
          .surfaces = part(out.surfaces, first, count)};
}

const CastKernels& kernels_for(Isa isa) {
  return build_for(isa, baseline::kCastKernels, v3::kCastKernels);
}

class ExactCaster : public Caster {
 public:
  ExactCaster(const World& world, Isa isa)
      : kernels_(kernels_for(isa)),
        surfaces_(world),
        tree_(surfaces_.walls),
        circle_tree_(diagonals(surfaces_.circles)) {}

  RayHit cast(const Ray& ray, double range_max_m) const override {
    return cast(ray, range_max_m, surfaces_.placed(ray.time_s));
  }

  void cast_scans(std::span<const Pose2> world_from_sensor, std::span<const double> stamps_s, const ScanGeometry& beams,
                  double range_max_m, const HitBuffers& out) const override {
    const auto n = static_cast<std::size_t>(beams.beams());
    const bool swept = can_be_swept(beams);
    ScanScratch scratch(beams);
    for (std::size_t k = 0; k < world_from_sensor.size(); ++k) {
      const Pose2& pose = world_from_sensor[k];
      const std::vector<PlacedCircle> moved = surfaces_.placed(stamps_s.empty() ? 0.0 : stamps_s[k]);
      if (swept) {
        sweep(scratch.aim(pose, kernels_), scratch, range_max_m, moved, part(out, k * n, n));
        continue;
      }
      for (std::size_t i = 0; i < n; ++i) {
        const Vec2 direction = pose.rotate(beams.direction(static_cast<int>(i)));
        store_hit(cast({pose.translation(), direction, 0.0}, range_max_m, moved), k * n + i, out);
      }
    }
  }

  void cast_bent_scan(const BentScan& scan, const ScanGeometry& beams, double range_max_m,
                      const HitBuffers& out) const override {
    const std::vector<PlacedCircle> moved = surfaces_.placed(scan.stamp_s);
    if (can_be_swept(beams)) {
      ScanScratch scratch(beams);
      sweep(scratch.aim(scan), scratch, range_max_m, moved, out);
      return;
    }
    for (std::size_t i = 0; i < scan.directions.size(); ++i)
      store_hit(cast({scan.world_from_sensor.translation(), scan.directions[i], 0.0}, range_max_m, moved), i, out);
  }

 private:
  // The sweep counts beams by their angle, once around.
  static bool can_be_swept(const ScanGeometry& beams) {
    return beams.beams() >= kFewBeams && beams.angle_step() != 0 &&
           std::fabs(beams.angle_step()) * (beams.beams() - 1) < kTwoPi;
  }

  RayHit cast(const Ray& ray, double range_max_m, std::span<const PlacedCircle> moved) const {
    const Vec2& o = ray.origin;
    const Vec2& d = ray.direction;
    NearestSurface nearest = kernels_.walk(tree_.view(), o.x(), o.y(), d.x(), d.y(), range_max_m);
    const BeamHits one{&nearest.range, &nearest.surface};
    const auto offer_round = [&](const PlacedCircle& circle, std::size_t i) {
      offer(range_to_circle(o, d, circle.center, circle.radius_m), static_cast<double>(surfaces_.walls.size() + i), 0,
            one);
    };
    const std::size_t circles = surfaces_.circles.size();
    if (circles > 0)
      walk_boxes(circle_tree_.view(), 0, o, d, nearest.range,
                 [&](std::size_t i) { offer_round(surfaces_.circles[i], i); });
    for (std::size_t i = 0; i < moved.size(); ++i) offer_round(moved[i], circles + i);
    return surfaces_.hit(o, d, nearest.range, static_cast<std::int32_t>(nearest.surface), range_max_m, moved);
  }

  void sweep(const BeamFan& fan, ScanScratch& scratch, double range_max_m, std::span<const PlacedCircle> moved,
             const HitBuffers& out) const {
    const BeamHits hits = scratch.clear(range_max_m, kernels_);
    const WallView walls = tree_.view();
    (walls.walls <= kSweepAllWalls ? kernels_.sweep_all : kernels_.sweep_tree)(walls, fan, hits);
    if (!surfaces_.circles.empty() || !moved.empty()) sweep_circles(fan, hits, range_max_m, moved);
    write(fan, hits, range_max_m, moved, out);
  }

  // Sweeps circles one by one; most of many are skipped, because they are farther away than every hit.
  void sweep_circles(const BeamFan& fan, const BeamHits& hits, double range_max_m,
                     std::span<const PlacedCircle> moved) const {
    const double farthest = std::min(range_max_m, *std::max_element(hits.range, hits.range + fan.beams));
    const Vec2 origin(fan.origin_x, fan.origin_y);
    auto surface = static_cast<double>(surfaces_.walls.size());
    for (const std::span<const PlacedCircle> circles : {std::span<const PlacedCircle>(surfaces_.circles), moved})
      for (const PlacedCircle& circle : circles) {
        const double reach = (farthest + circle.radius_m) * (1 + 1e-9) + 1e-6;
        if ((circle.center - origin).squaredNorm() <= reach * reach) offer_circle(circle, surface, fan, hits);
        surface += 1.0;
      }
  }

  void write(const BeamFan& fan, const BeamHits& hits, double range_max_m, std::span<const PlacedCircle> moved,
             const HitBuffers& out) const {
    const auto n = static_cast<std::size_t>(fan.beams);
    kernels_.finish(hits, fan.beams, range_max_m, static_cast<double>(surfaces_.walls.size()), out.ranges.data(),
                    out.wall_ids.data());
    if (!out.surfaces.empty())
      for (std::size_t i = 0; i < n; ++i)
        out.surfaces[i] = static_cast<std::int32_t>(hits.range[i] <= range_max_m ? hits.surface[i] : -1.0);
    if (out.cos_incidence.empty()) return;
    const Vec2 origin(fan.origin_x, fan.origin_y);
    for (std::size_t i = 0; i < n; ++i)
      out.cos_incidence[i] = surfaces_
                                 .hit(origin, {fan.dx[i], fan.dy[i]}, hits.range[i],
                                      static_cast<std::int32_t>(hits.surface[i]), range_max_m, moved)
                                 .cos_incidence;
  }

  const CastKernels& kernels_;
  Surfaces surfaces_;
  WallTree tree_;
  WallTree circle_tree_;  ///< over the circles' boxes
};

}  // namespace

std::unique_ptr<Caster> make_exact_caster(const World& world, Isa isa) {
  SCANBENCH_ASSERT(isa <= best_isa());
  return std::make_unique<ExactCaster>(world, isa);
}

}  // namespace scanbench::sim
