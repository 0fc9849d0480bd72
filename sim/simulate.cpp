// Frames are shared out in chunks; every frame writes to its own preassigned place.
#include "sim/simulate.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <exception>
#include <mutex>
#include <optional>
#include <span>
#include <thread>
#include <vector>

#include "core/error.hpp"
#include "core/geometry.hpp"
#include "core/pose2.hpp"
#include "core/sensor_model.hpp"
#include "core/truth.hpp"
#include "sim/noise.hpp"
#include "sim/ray_caster.hpp"

namespace scanbench::sim {
namespace {

constexpr std::size_t kFramesPerChunk = 8;  // about a millisecond of work
// Of Box2D: an empty world, and per surface a fixture, a shape, a proxy and two tree nodes (measured: 360 to 450
// bytes).
constexpr std::uint64_t kBytesPerWorld = 160 * 1024;
constexpr std::uint64_t kBytesPerSurface = 512;

std::size_t surfaces(const World& world) {
  return world.walls.size() + world.circles.size() + world.moving.size();
}

// Scratch of one thread.
struct Scratch {
  std::vector<Ray> rays;
  std::vector<double> cos_incidence;
};

class Simulation {
 public:
  Simulation(const SimulationInput& input, Recording& recording)
      : input_(input),
        caster_(input.world),
        floor_surface_(static_cast<std::int32_t>(surfaces(input.world))),
        recording_(recording) {}

  void frame(std::size_t k, Scratch& scratch) const {
    const SensorModel& sensor = input_.sensor;
    const auto n = static_cast<std::size_t>(sensor.geometry.beams());
    Truth& truth = *recording_.truth;
    const std::span<double> true_ranges(truth.ranges.data() + k * n, n);
    const std::span<std::int32_t> wall_ids(truth.wall_ids.data() + k * n, n);
    scratch.cos_incidence.resize(n);
    const HitBuffers buffers{true_ranges, wall_ids, scratch.cos_incidence};
    const TimedPose& start = input_.trajectory.poses[k];
    std::optional<TiltRotation> tilt;
    if (!input_.tilt.level()) tilt.emplace(tilt_angles(input_.tilt, input_.seed, static_cast<std::uint32_t>(k)));
    const bool imperfect_beams = tilt || sensor.noise.bearing_sigma_rad > 0 || sensor.noise.beam_divergence_rad > 0;
    if (input_.sweep || imperfect_beams) aim(k, scratch);
    if (input_.sweep)
      caster_.cast_rays(scratch.rays, sensor.range_max_m, buffers);
    else
      caster_.cast_scans({&start.world_from_sensor, 1}, {&start.stamp_s, 1}, sensor.geometry, sensor.range_max_m,
                         buffers);
    std::vector<double>& ranges = recording_.observed.frames[k].ranges;
    for (std::size_t i = 0; i < n; ++i) {
      const BeamAddress address{input_.seed, static_cast<std::uint32_t>(k), static_cast<std::uint32_t>(i)};
      RayHit hit;
      if (imperfect_beams) {
        hit = real_beam({scratch.rays[i], sensor.geometry.direction(static_cast<int>(i))}, tilt, address);
      } else {
        hit.range_m = true_ranges[i];
        hit.cos_incidence = scratch.cos_incidence[i];
      }
      ranges[i] = observed_range(sensor, hit.range_m, hit.cos_incidence, address);
    }
  }

 private:
  struct Beam {
    Ray ray;         // of a level sensor
    Vec2 in_sensor;  // direction in the sensor's frame

    Beam aside(double angle_rad) const {
      return {{ray.origin, rotated(ray.direction, angle_rad), ray.time_s}, rotated(in_sensor, angle_rad)};
    }
  };

  // The nominal beams of a frame.
  void aim(std::size_t k, Scratch& scratch) const {
    const SensorModel& sensor = input_.sensor;
    const TimedPose& start = input_.trajectory.poses[k];
    scratch.rays.clear();
    for (int i = 0; i < sensor.geometry.beams(); ++i) {
      const double after_s = input_.sweep ? i * sensor.time_per_beam_s : 0.0;
      const Pose2 pose = input_.sweep ? pose_during_scan(input_.trajectory, k, after_s) : start.world_from_sensor;
      scratch.rays.push_back({pose.translation(), pose.rotate(sensor.geometry.direction(i)), start.stamp_s + after_s});
    }
  }

  // What the light of a beam meets, the range being along it. The floor counts as one more surface.
  RayHit meet(const Beam& beam, const std::optional<TiltRotation>& tilt) const {
    const double range_max_m = input_.sensor.range_max_m;
    if (!tilt) return caster_.cast(beam.ray, range_max_m);
    const TiltedBeam tilted = tilt->beam(beam.in_sensor);
    const Vec2& level = beam.ray.direction;
    const Vec2 direction(tilted.turn.x() * level.x() - tilted.turn.y() * level.y(),
                         tilted.turn.y() * level.x() + tilted.turn.x() * level.y());
    RayHit hit = caster_.cast({beam.ray.origin, direction, beam.ray.time_s}, range_max_m * tilted.horizontal);
    hit.range_m = tilted.range(hit.range_m);
    hit.cos_incidence *= tilted.horizontal;
    const double floor_m = tilted.range_to_floor(input_.tilt.height_m);
    if (floor_m < hit.range_m && floor_m <= range_max_m)
      hit = {.range_m = floor_m, .wall = -1, .surface = floor_surface_, .cos_incidence = -tilted.up};
    return hit;
  }

  // What a beam meets that points a little beside its nominal direction and is a little wide.
  RayHit real_beam(const Beam& nominal, const std::optional<TiltRotation>& tilt, const BeamAddress& address) const {
    const SensorModel& sensor = input_.sensor;
    const Beam beam = nominal.aside(bearing_error(sensor.noise, address));
    RayHit hit = meet(beam, tilt);
    const double half_width = 0.5 * sensor.noise.beam_divergence_rad;
    if (!(half_width > 0)) return hit;
    const RayHit left = meet(beam.aside(half_width), tilt);
    const RayHit right = meet(beam.aside(-half_width), tilt);
    // A depth edge: two surfaces, farther apart in range than the beam is wide. Less is a corner seen at a slant.
    const double width = sensor.noise.beam_divergence_rad * std::min(left.range_m, right.range_m);
    if (hit.surface >= 0 && left.surface >= 0 && right.surface >= 0 && left.surface != right.surface &&
        std::fabs(left.range_m - right.range_m) > width)
      hit.range_m = mixed_range(left.range_m, right.range_m, address);
    return hit;
  }

  const SimulationInput& input_;
  RayCaster caster_;
  const std::int32_t floor_surface_;  // after all surfaces of the world
  Recording& recording_;
};

// Runs work(first, last) over [0, count) in chunks on `threads` threads, this one included; all are joined before it
// returns or throws. The first exception ends the rest.
template <class Work>
void in_chunks(std::size_t count, int threads, const std::function<void(double)>& progress, const Work& work) {
  std::atomic<std::size_t> next{0};
  std::mutex mutex;
  std::size_t done = 0;
  std::exception_ptr failure;
  const auto worker = [&] {
    try {
      Scratch scratch;
      for (;;) {
        const std::size_t first = next.fetch_add(kFramesPerChunk);
        if (first >= count) return;
        const std::size_t last = std::min(first + kFramesPerChunk, count);
        work(first, last, scratch);
        const std::lock_guard lock(mutex);
        done += last - first;
        if (progress && !failure) progress(static_cast<double>(done) / static_cast<double>(count));
      }
    } catch (...) {
      next = count;
      const std::lock_guard lock(mutex);
      if (!failure) failure = std::current_exception();
    }
  };
  {
    const std::size_t chunks = (count + kFramesPerChunk - 1) / kFramesPerChunk;
    std::vector<std::jthread> others;
    for (std::size_t i = 1; i < std::min(static_cast<std::size_t>(threads), chunks); ++i) others.emplace_back(worker);
    worker();
  }
  if (failure) std::rethrow_exception(failure);
}

Recording prepare(const SimulationInput& input) {
  const auto& poses = input.trajectory.poses;
  const auto n = static_cast<std::size_t>(input.sensor.geometry.beams());
  Recording recording;
  recording.observed.sensor = input.sensor;
  recording.observed.frames.resize(poses.size());
  Truth& truth = recording.truth.emplace();
  truth.walls = input.world.walls;
  truth.ranges.resize(poses.size() * n);
  truth.wall_ids.resize(poses.size() * n);
  truth.world_from_sensor.reserve(poses.size());
  for (const TimedPose& pose : poses) truth.world_from_sensor.push_back(pose.world_from_sensor);
  const std::vector<Pose2> odometry = odometry_poses(truth.world_from_sensor, input.odometry, input.seed);
  for (std::size_t k = 0; k < poses.size(); ++k) {
    Frame& frame = recording.observed.frames[k];
    frame.stamp_s = poses[k].stamp_s;
    frame.odom_from_sensor = odometry[k];
    frame.ranges.resize(n);
  }
  return recording;
}

}  // namespace

std::uint64_t memory_estimate(const SimulationInput& input) {
  const std::uint64_t frames = input.trajectory.poses.size();
  const auto beams = static_cast<std::uint64_t>(input.sensor.geometry.beams());
  const std::uint64_t per_beam = 2 * sizeof(double) + sizeof(std::int32_t);
  const std::uint64_t per_frame = sizeof(Frame) + 2 * sizeof(Pose2) + 32;
  const std::uint64_t scratch = beams * (sizeof(Ray) + sizeof(double));
  return frames * (beams * per_beam + per_frame) + kBytesPerWorld +
         surfaces(input.world) * (sizeof(Wall) + kBytesPerSurface) + scratch;
}

Recording simulate(const SimulationInput& input, int threads, const std::function<void(double)>& progress) {
  SCANBENCH_ASSERT(threads >= 1);
  if (input.sweep && !(input.sensor.time_per_beam_s > 0))
    throw ConfigError("sweep is on, but the sensor's time_per_beam_s is 0; it must be > 0 for a scan that is swept");
  validate(input.world);
  check_clear(input.world, input.trajectory, input.sensor.range_max_m);
  Recording recording = prepare(input);
  const Simulation simulation(input, recording);
  in_chunks(input.trajectory.poses.size(), threads, progress,
            [&](std::size_t first, std::size_t last, Scratch& scratch) {
              for (std::size_t k = first; k < last; ++k) simulation.frame(k, scratch);
            });
  return recording;
}

}  // namespace scanbench::sim
