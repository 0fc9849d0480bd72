// Beams per second of the simulator: fifteen walls, 200 scans of 451 beams, compared with a brute-force caster in
// double.
//
//   simulate            whole recordings, gaussian noise of 5 cm included, one thread
//   cast                the same beams through sim/ray_caster.hpp, no noise
//   cast_brute_force    the same beams, each intersected with every wall
//   rooms/...           both casters in an office of N walls
//
// items_per_second is beams per second of one core's time.
#include <benchmark/benchmark.h>

#include "core/index.hpp"
#include "core/registry.hpp"
#include "sim/ray_caster.hpp"
#include "sim/ray_math.hpp"
#include "sim/sensors.hpp"
#include "sim/simulate.hpp"

namespace scanbench::sim {
namespace {

World fifteen_walls() {
  World world;
  world.name = "fifteen walls";
  const double rows[15][4] = {{1.55, 0.75, 1.55, 1.65},    {1.95, 2.20, 2.45, 3.25},  {1.25, 11.25, 1.80, 11.25},
                              {1.55, 0.75, 1.55, 3.90},    {2.75, 0.00, 2.75, 0.45},  {9.75, 7.45, 9.75, 11.40},
                              {2.70, 10.00, 3.35, 10.00},  {0.00, 2.35, 0.00, 5.90},  {2.85, 5.15, 1.55, 3.75},
                              {11.15, 13.35, 13.5, 13.35}, {9.70, 7.40, 10.35, 7.40}, {1.90, 10.90, 2.50, 10.90},
                              {1.55, 10.90, 5.90, 10.90},  {3.20, 0.95, 3.20, 2.05},  {3.30, 9.90, 4.05, 9.70}};
  for (const auto& r : rows)
    world.walls.push_back({std::to_string(world.walls.size() + 1), {{r[0], r[1]}, {r[2], r[3]}}});
  return world;
}

// `side` x `side` rooms of 6 m x 5 m with doors.
World rooms(int side) {
  World world;
  world.name = "rooms";
  const auto add = [&](const Vec2& a, const Vec2& b) {
    world.walls.push_back({std::to_string(world.walls.size() + 1), {a, b}});
  };
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j) {
      const Vec2 o(6.0 * i, 5.0 * j);
      add(o, o + Vec2(2.5, 0));
      add(o + Vec2(3.5, 0), o + Vec2(6, 0));
      add(o, o + Vec2(0, 1.7));
      add(o + Vec2(0, 2.6), o + Vec2(0, 5));
      add(o + Vec2(1.1, 3.3), o + Vec2(2.3, 3.9));
    }
  return world;
}

Trajectory two_hundred_poses() {
  const NamedPoints corners{{"A", {6.45, 3.15}}, {"B", {4.60, 1.50}}, {"C", {2.30, 8.15}},
                            {"D", {7.25, 6.00}}, {"E", {5.10, 7.45}}, {"F", {1.35, 7.70}}};
  return Registry<TrajectoryKind>::make("waypoints", {{"points_m", corners}, {"scans", std::int64_t{200}}})
      ->generate(0.1);
}

// Casts all scans as a batch; `cast` writes their ranges and wall ids.
template <class Cast>
void run(benchmark::State& state, const ScanGeometry& beams, const Cast& cast) {
  std::vector<Pose2> poses;
  for (const TimedPose& pose : two_hundred_poses().poses) poses.push_back(pose.world_from_sensor);
  const std::size_t count = poses.size() * as_index(beams.beams());
  std::vector<double> ranges(count);
  std::vector<std::int32_t> wall_ids(count);
  for (auto _ : state) {
    cast(poses, ranges, wall_ids);
    benchmark::DoNotOptimize(ranges.data());
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(count));
}

void cast_with_ray_caster(benchmark::State& state, const World& world) {
  const SensorModel sensor = make_sensor("ladar_2d30", {});
  const RayCaster caster(world);
  run(state, sensor.geometry, [&](const auto& poses, auto& ranges, auto& wall_ids) {
    caster.cast_scans(poses, {}, sensor.geometry, sensor.range_max_m, {ranges, wall_ids, {}});
  });
}

void cast_with_brute_force(benchmark::State& state, const World& world) {
  const SensorModel sensor = make_sensor("ladar_2d30", {});
  run(state, sensor.geometry, [&](const auto& poses, auto& ranges, auto& wall_ids) {
    std::size_t at = 0;
    for (const Pose2& pose : poses)
      for (int i = 0; i < sensor.geometry.beams(); ++i, ++at) {
        const Vec2 direction = pose.rotate(sensor.geometry.direction(i));
        double best = kNoHit;
        std::int32_t id = -1;
        for (std::size_t w = 0; w < world.walls.size(); ++w) {
          const double range = range_to_wall(pose.translation(), direction, world.walls[w].segment);
          if (range >= best || range > sensor.range_max_m) continue;
          best = range;
          id = static_cast<std::int32_t>(w);
        }
        ranges[at] = best;
        wall_ids[at] = id;
      }
  });
}

void BM_simulate(benchmark::State& state) {
  SimulationInput input;
  input.world = fifteen_walls();
  input.sensor = make_sensor("ladar_2d30", {});
  input.trajectory = two_hundred_poses();
  for (auto _ : state) benchmark::DoNotOptimize(simulate(input));
  state.SetItemsProcessed(state.iterations() * 200 * 451);
}
BENCHMARK(BM_simulate)->Name("simulate")->Unit(benchmark::kMillisecond);

void BM_cast(benchmark::State& state) {
  cast_with_ray_caster(state, fifteen_walls());
}
BENCHMARK(BM_cast)->Name("cast")->Unit(benchmark::kMillisecond);

void BM_brute_force(benchmark::State& state) {
  cast_with_brute_force(state, fifteen_walls());
}
BENCHMARK(BM_brute_force)->Name("cast_brute_force")->Unit(benchmark::kMillisecond);

void BM_rooms(benchmark::State& state) {
  cast_with_ray_caster(state, rooms(static_cast<int>(state.range(0))));
}
BENCHMARK(BM_rooms)->Name("rooms/cast")->Arg(5)->Arg(14)->Arg(45)->Unit(benchmark::kMillisecond);

void BM_rooms_brute_force(benchmark::State& state) {
  cast_with_brute_force(state, rooms(static_cast<int>(state.range(0))));
}
BENCHMARK(BM_rooms_brute_force)->Name("rooms/cast_brute_force")->Arg(5)->Arg(14)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace scanbench::sim
