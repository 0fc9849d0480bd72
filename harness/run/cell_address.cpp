// The address of a cell: a hash of everything that its bytes depend on.
#include "harness/run/cell_address.hpp"

#include <variant>

#include "core/number_text.hpp"
#include "harness/files/hash.hpp"

namespace scanbench::harness {
namespace {

void add_params(Sha256& hash, const ParamSet& params) {
  for (const auto& [name, value] : params)
    hash.part(name, std::to_string(value.index()) + " " + to_text(value));  // 1 and "1" are two values
}

void add_choice(Sha256& hash, const ModuleChoice& choice) {
  hash.part("kind", choice.kind).part("module", choice.module);
  add_params(hash, choice.params);
}

void add_points(Sha256& hash, const std::string& label, std::initializer_list<Vec2> points) {
  hash.part("label", label);
  for (const Vec2& p : points) hash.part("point", number_text(p.x()) + " " + number_text(p.y()));
}

/// The world itself, not its file: it may as well be written into the scenario.
void add_world(Sha256& hash, const sim::World& world) {
  for (const auto& wall : world.walls) add_points(hash, wall.label, {wall.segment.a, wall.segment.b});
  for (const auto& circle : world.circles)
    add_points(hash.part("circle", number_text(circle.radius_m)), circle.label, {circle.center});
  for (const auto& body : world.moving) {
    hash.part("moving", number_text(body.radius_m)).part("speed", number_text(body.speed_mps));
    hash.part("loop", body.loop ? "yes" : "no");
    add_points(hash, body.label, {});
    for (const Vec2& p : body.path) add_points(hash, "path", {p});
  }
}

void add_input(Sha256& hash, const SimulatedInput& input) {
  hash.part("input", "simulated").part("world", input.world_text).part("sensor", input.sensor_preset);
  add_world(hash, input.world);
  add_params(hash, input.sensor_params);
  add_choice(hash, input.trajectory);
  const auto& odometry = input.odometry;
  for (const double value : {odometry.translation_per_m, odometry.rotation_per_m_rad, odometry.rotation_per_rad,
                             odometry.pose_position_sigma_m, odometry.pose_heading_sigma_rad})
    hash.part("odometry", number_text(value));
  for (const double value : {input.tilt.roll_sigma_rad, input.tilt.pitch_sigma_rad, input.tilt.height_m})
    hash.part("tilt", number_text(value));
  hash.part("sweep", input.sweep ? "yes" : "no");
}

void add_input(Sha256& hash, const RecordedInput& input) {
  hash.part("input", "recorded").part("log", sha256_of_file(input.log)).part("format", input.format);
  add_params(hash, input.params);
  hash.part("sensor", input.sensor_preset);
  add_params(hash, input.sensor_params);
}

void add_input(Sha256& hash, const LinesInput& input) {
  hash.part("input", "lines");
  if (input.world) add_world(hash, *input.world);
  add_params(hash, input.params);
  for (const auto& frame : input.frames) {
    hash.part("frame", std::to_string(frame.size()));
    for (const Segment& line : frame) add_points(hash, "line", {line.a, line.b});
  }
}

}  // namespace

std::string input_address(const Scenario& scenario) {
  Sha256 hash;
  std::visit([&](const auto& input) { add_input(hash, input); }, scenario.input);
  return hash.hex();
}

std::string cell_address(const std::string& input, const std::vector<ModuleChoice>& metrics,
                         const PipelineSpec& pipeline, std::uint64_t seed, const TraceChoice& trace) {
  Sha256 hash;
  hash.part("schema", "1").part("code", code_version()).part("input", input).part("seed", std::to_string(seed));
  for (const auto& slot : pipeline.slots) add_choice(hash, slot);
  for (const auto& choice : metrics) add_choice(hash, choice);
  return hash.part("trace", trace.text()).hex();
}

}  // namespace scanbench::harness
