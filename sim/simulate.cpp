// Simulates chunks of frames on several threads; every frame writes to its own memory.
#include "sim/simulate.hpp"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <span>
#include <thread>
#include <vector>

#include "core/error.hpp"
#include "core/geometry/geometry.hpp"
#include "core/geometry/pose2.hpp"
#include "core/sensor_model.hpp"
#include "core/truth.hpp"
#include "sim/noise.hpp"
#include "sim/ray_caster.hpp"
#include "sim/real_beams.hpp"

namespace scanbench::sim {
namespace {

constexpr std::size_t kFramesPerChunk = 8;
// Memory of Box2D, which needs more than the other caster: an empty world, and per surface a fixture, a shape, a proxy
// and two tree nodes (measured: 360 to 450 bytes).
constexpr std::uint64_t kBytesPerWorld = 160 * 1024;
constexpr std::uint64_t kBytesPerSurface = 512;

std::size_t surfaces(const World& world) {
  return world.walls.size() + world.circles.size() + world.moving.size();
}

class Simulation {
 public:
  Simulation(const SimulationInput& input, Recording& recording)
      : input_(input), caster_(input.world, input.caster), recording_(recording) {}

  const SimulationInput& input() const { return input_; }
  const RayCaster& caster() const { return caster_; }
  Recording& recording() const { return recording_; }

 private:
  const SimulationInput& input_;
  RayCaster caster_;
  Recording& recording_;
};

// The frames that one thread simulates, and its scratch memory.
class Worker {
 public:
  explicit Worker(const Simulation& simulation)
      : input_(simulation.input()),
        caster_(simulation.caster()),
        recording_(simulation.recording()),
        noise_(input_.sensor, input_.seed),
        real_beams_(caster_, input_.sensor, input_.tilt, input_.seed,
                    static_cast<std::int32_t>(surfaces(input_.world))),
        real_(RealBeams::needed(input_.sensor.noise, input_.tilt)),
        incidence_(ScanNoise::needs_incidence(input_.sensor.noise)) {}

  void frames(std::size_t first, std::size_t last) {
    cast_nominal(first, last);
    for (std::size_t k = first; k < last; ++k) observe(k, first);
  }

 private:
  std::size_t beams() const { return static_cast<std::size_t>(input_.sensor.geometry.beams()); }
  const TimedPose& start(std::size_t k) const { return input_.trajectory.poses[k]; }

  // Casts the truth: ranges and walls of the nominal beams.
  void cast_nominal(std::size_t first, std::size_t last) {
    const std::size_t n = beams();
    Truth& truth = *recording_.truth;
    const std::size_t count = (last - first) * n;
    cos_incidence_.resize(incidence_ ? count : 0);
    const HitBuffers out{.ranges = std::span(truth.ranges).subspan(first * n, count),
                         .wall_ids = std::span(truth.wall_ids).subspan(first * n, count),
                         .cos_incidence = cos_incidence_};
    if (input_.sweep) {
      rays_.clear();
      for (std::size_t k = first; k < last; ++k) aim(k);
      caster_.cast_rays(rays_, input_.sensor.range_max_m, out);
      return;
    }
    stamps_.clear();
    for (std::size_t k = first; k < last; ++k) stamps_.push_back(start(k).stamp_s);
    caster_.cast_scans(std::span(truth.world_from_sensor).subspan(first, last - first), stamps_, input_.sensor.geometry,
                       input_.sensor.range_max_m, out);
  }

  // Appends the nominal beams of a frame.
  void aim(std::size_t k) {
    const SensorModel& sensor = input_.sensor;
    for (int i = 0; i < sensor.geometry.beams(); ++i) {
      const double after_s = input_.sweep ? i * sensor.time_per_beam_s : 0.0;
      const Pose2 pose = input_.sweep ? pose_during_scan(input_.trajectory, k, after_s) : start(k).world_from_sensor;
      rays_.push_back({pose.translation(), pose.rotate(sensor.geometry.direction(i)), start(k).stamp_s + after_s});
    }
  }

  // The losses of the walls that the nominal beams of a frame hit; empty if no wall has one.
  std::span<const double> losses(std::size_t k) {
    const std::vector<double>& of_wall = input_.world.losses;
    if (of_wall.empty()) return {};
    const std::size_t n = beams();
    losses_.assign(n, 0.0);
    for (std::size_t i = 0; i < n; ++i)
      if (const std::int32_t wall = recording_.truth->wall_ids[k * n + i]; wall >= 0)
        losses_[i] = of_wall[static_cast<std::size_t>(wall)];
    return losses_;
  }

  void observe(std::size_t k, std::size_t first) {
    const std::size_t n = beams();
    const auto frame = static_cast<std::uint32_t>(k);
    const std::span<double> readings(recording_.observed.frames[k].ranges);
    if (!real_) {
      const std::span<const double> incidence(cos_incidence_);
      noise_.observe(frame, std::span(recording_.truth->ranges).subspan(k * n, n),
                     incidence_ ? incidence.subspan((k - first) * n, n) : incidence, readings, losses(k));
      return;
    }
    if (!input_.sweep) {
      rays_.clear();
      aim(k);
    }
    const std::size_t at = input_.sweep ? (k - first) * n : 0;
    real_ranges_.resize(n);
    real_cos_.resize(n);
    real_beams_.meet({frame, start(k), input_.sweep, std::span<const Ray>(rays_).subspan(at, n)},
                     noise_.bearing_errors(frame, n), real_ranges_, real_cos_);
    noise_.observe(frame, real_ranges_, real_cos_, readings, losses(k));
  }

  const SimulationInput& input_;
  const RayCaster& caster_;
  Recording& recording_;
  ScanNoise noise_;
  RealBeams real_beams_;
  bool real_;
  bool incidence_;
  std::vector<double> stamps_, cos_incidence_, real_ranges_, real_cos_, losses_;
  std::vector<Ray> rays_;
};

// Runs frames(first, last) of workers over [0, count) in chunks. Each of `threads` threads, this one included, has its
// own worker from make_worker(); all are joined before it returns or throws. The first exception ends the rest.
template <class MakeWorker>
void in_chunks(std::size_t count, int threads, const std::function<void(double)>& progress,
               const MakeWorker& make_worker) {
  std::atomic<std::size_t> next{0};
  std::mutex mutex;
  std::size_t done = 0;
  std::exception_ptr failure;
  const auto worker = [&] {
    try {
      auto frames = make_worker();
      for (;;) {
        const std::size_t first = next.fetch_add(kFramesPerChunk);
        if (first >= count) return;
        const std::size_t last = std::min(first + kFramesPerChunk, count);
        frames.frames(first, last);
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
  const std::uint64_t scratch = kFramesPerChunk * beams * (sizeof(Ray) + 8 * sizeof(double));
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
  in_chunks(input.trajectory.poses.size(), threads, progress, [&] { return Worker(simulation); });
  return recording;
}

}  // namespace scanbench::sim
