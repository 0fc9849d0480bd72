// Writes notes on recordings from the effective scenario.
#include "harness/results/figures/recording_note.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <variant>
#include <vector>

#include "core/geometry/angles.hpp"
#include "core/names.hpp"
#include "core/params.hpp"
#include "core/sensor_model.hpp"

namespace scanbench::results {
namespace {

std::string text_of(std::span<const std::uint64_t> seeds) {
  return seeds.size() == 1 ? fmt::format("seed {}", seeds.front()) : fmt::format("{} seeds", seeds.size());
}

std::string text_of(const study::SimulatedInput& input, std::span<const std::uint64_t> seeds) {
  std::vector<std::string> facts{"Simulated with " + text_of(seeds)};
  if (!input.tilt.level())
    facts.push_back(
        fmt::format("the sensor is tilted anew for each scan (standard deviations {:.3g} deg of roll, "
                    "{:.3g} deg of pitch)",
                    degrees(input.tilt.roll_sigma_rad), degrees(input.tilt.pitch_sigma_rad)));
  facts.emplace_back(input.odometry.any() ? "poses by odometry with errors" : "odometry without errors");
  if (input.sweep) facts.emplace_back("the sensor moves while it scans");
  return join(facts, "; ") + ".";
}

std::string text_of(const study::RecordedInput& input, std::span<const std::uint64_t> seeds) {
  std::string text = "Recorded log " + input.log.filename().string();
  if (const auto poses = input.params.find("poses"); poses != input.params.end())
    text += fmt::format(", its {} poses", to_text(poses->second));
  if (input.odometry.any()) text += fmt::format(" with added errors of {}", text_of(seeds));
  return text + ".";
}

std::string text_of(const study::LinesInput& input, std::span<const std::uint64_t> seeds) {
  return input.file.empty() ? fmt::format("Copies of the walls with {}.", text_of(seeds))
                            : "Lines of " + input.file_name + ".";
}

}  // namespace

std::string recording_note(const study::Scenario& scenario, std::span<const std::uint64_t> seeds) {
  return std::visit([seeds](const auto& input) { return text_of(input, seeds); }, scenario.input);
}

std::string condition_text(const study::Scenario& scenario) {
  if (std::holds_alternative<study::RecordedInput>(scenario.input)) return "recorded log";
  const auto* simulated = std::get_if<study::SimulatedInput>(&scenario.input);
  if (simulated == nullptr) return "";
  const SensorNoise& noise = simulated->sensor.noise;
  std::vector<std::string> parts;
  if (noise.sigma_m > 0) parts.push_back(fmt::format("{:.3g} cm", 100.0 * noise.sigma_m));
  if (noise.sigma_relative > 0) parts.push_back(fmt::format("{:.3g} % of the range", 100.0 * noise.sigma_relative));
  return fmt::format("sensor {}, range noise {}", simulated->sensor_preset,
                     parts.empty() ? "none" : join(parts, noise.relative_from_m > 0 ? " or, farther away, " : " and "));
}

std::string bound_note(const study::Scenario& scenario) {
  const auto* simulated = std::get_if<study::SimulatedInput>(&scenario.input);
  const bool has_bound = std::ranges::any_of(scenario.metrics, [](const study::ModuleChoice& family) {
    return family.module == "efficiency" || family.module == "pose_efficiency" || family.module == "alignment";
  });
  if (simulated == nullptr || !has_bound) return "";
  std::vector<std::string> causes;
  if (simulated->sweep) causes.emplace_back("the sensor moves while it scans");
  if (!simulated->tilt.level()) causes.emplace_back("the sensor is tilted");
  if (causes.empty()) return "";
  return fmt::format(
      "Bounds are those of a still, level sensor. Here {}: ratios to the bounds also contain what that does to the "
      "readings, and 1 cannot be reached.",
      join(causes, " and "));
}

std::string recording_title_note(const study::Scenario& scenario, std::span<const std::uint64_t> seeds) {
  std::vector<std::string> facts;
  if (const auto* simulated = std::get_if<study::SimulatedInput>(&scenario.input))
    if (!simulated->tilt.level()) facts.emplace_back("tilted sensor");
  if (seeds.size() == 1 && scenario.seeds.size() > 1)
    facts.push_back(fmt::format("seed {} of {} seeds", seeds.front(), scenario.seeds.size()));
  return join(facts);
}

}  // namespace scanbench::results
