// Groups the scenarios of a benchmark by start error and sensor, and averages the success in each group.
#include "harness/results/figures/basin_chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/geometry/angles.hpp"
#include "harness/results/analysis/benchmark.hpp"
#include "harness/results/analysis/statistics.hpp"

namespace scanbench::results {
namespace {

using StartError = std::pair<double, double>;  // standard deviations, cm and deg

StartError start_error(const study::Scenario& scenario) {
  const sim::OdometryNoise& noise = std::get<study::SimulatedInput>(scenario.input).odometry;
  return {100.0 * noise.pose_position_sigma_m, degrees(noise.pose_heading_sigma_rad)};
}

const std::string& sensor_of(const study::Scenario& scenario) {
  return std::get<study::SimulatedInput>(scenario.input).sensor_preset;
}

constexpr std::size_t kMostSensors = 2;  // as many curves as a facet can distinguish

}  // namespace

render::FacetChart basin_chart(const std::vector<study::Scenario>& scenarios, const std::vector<runs::SummaryRow>& rows,
                               const std::vector<std::string>& pipelines, const study::BenchmarkColumn& column) {
  const CellValues values = values_of(rows, column.metric);
  const std::vector<std::uint64_t> seeds = seeds_of(rows);
  std::vector<std::string> sensors;
  std::map<StartError, std::map<std::string, std::vector<std::string>>> names;  // by start error and sensor
  for (const study::Scenario& scenario : scenarios) {
    const std::string& sensor = sensor_of(scenario);
    if (std::ranges::find(sensors, sensor) == sensors.end()) sensors.push_back(sensor);
    names[start_error(scenario)][sensor].push_back(scenario.name);
  }
  sensors.resize(std::min(sensors.size(), kMostSensors));
  render::FacetChart chart{.title = column.head + " against the error of the given poses",
                           .x = {.label = "start error, σ [cm/°]"},
                           .y = {.label = column.head, .range = std::pair(-4.0, 104.0)},
                           .curve_names = sensors};
  for (const auto& [start, by_sensor] : names)
    chart.x.ticks.emplace_back(static_cast<double>(chart.x.ticks.size()),
                               fmt::format("{:.3g}/{:.3g}", start.first, start.second));
  for (const std::string& pipeline : pipelines) {
    render::Facet facet{.title = pipeline};
    for (const std::string& sensor : sensors) {
      render::FacetCurve curve;
      double place = 0.0;
      for (const auto& [start, by_sensor] : names) {
        const double x = place++;
        const auto group = by_sensor.find(sensor);
        if (group == by_sensor.end()) continue;
        const MeanInterval interval = mean_interval(per_seed(values, pipeline, seeds, group->second));
        if (!std::isfinite(interval.mean)) continue;
        const auto shown = [&](double share) { return column.scale * std::clamp(share, 0.0, 1.0); };
        curve.points.emplace_back(x, shown(interval.mean));
        if (std::isfinite(interval.low)) curve.intervals.push_back({x, shown(interval.low), shown(interval.high)});
      }
      facet.curves.push_back(std::move(curve));
    }
    chart.facets.push_back(std::move(facet));
  }
  return chart;
}

}  // namespace scanbench::results
