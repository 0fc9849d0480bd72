// Draws the figures of a benchmark: curves from summary and matches, in the panels of render/charts/facets.
#include "harness/results/figures/benchmark_figures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/registry.hpp"
#include "core/ticks.hpp"
#include "harness/io/files/atomic_file.hpp"
#include "harness/io/files/csv.hpp"
#include "harness/results/analysis/error_bins.hpp"
#include "harness/results/figures/basin_chart.hpp"
#include "harness/runs/store/run_folder.hpp"
#include "harness/runs/store/run_store.hpp"
#include "harness/runs/store/stored_files.hpp"
#include "harness/runs/store/summary.hpp"
#include "harness/study/scenario/benchmark_spec.hpp"
#include "render/charts/facets.hpp"
#include "render/figure.hpp"

namespace scanbench::results {
namespace {

namespace fs = std::filesystem;
using render::Facet;
using render::FacetChart;
using render::FacetCurve;
using render::log_range;

constexpr std::int64_t kLeastMatches = 30;  // per point of a curve
constexpr double kFirstRange = 1.0;         // m; bins are a third of an octave wide
const double kRangeRatio = std::cbrt(2.0);
constexpr double kFirstBound = 0.1;  // cm, deg; bins are a quarter of a decade wide
const double kBoundRatio = std::pow(10.0, 0.25);

/// The matches of one pipeline, binned.
struct MatchBins {
  ErrorBins offset_by_range{kFirstRange, kRangeRatio};
  ErrorBins angle_by_range{kFirstRange, kRangeRatio};
  ErrorBins offset_by_bound{kFirstBound, kBoundRatio};
  ErrorBins angle_by_bound{kFirstBound, kBoundRatio};
};

void add_matches(const runs::StoredFiles& cell, std::uint64_t seed, bool by_range, MatchBins& bins) {
  if (!cell.has("matches.csv")) return;
  const io::CsvTable csv =
      cell.table("matches.csv", {"range_m", "offset_m", "angle_rad", "bound_offset_m", "bound_angle_rad"});
  for (std::size_t r = 0; r < csv.rows(); ++r) {
    const double range = csv.number(r, "range_m");
    const double offset = 100.0 * csv.number(r, "offset_m");
    const double angle = degrees(csv.number(r, "angle_rad"));
    const double offset_bound = 100.0 * csv.number(r, "bound_offset_m");
    const double angle_bound = degrees(csv.number(r, "bound_angle_rad"));
    if (by_range) {
      bins.offset_by_range.add(seed, range, offset, offset_bound);
      bins.angle_by_range.add(seed, range, angle, angle_bound);
    }
    bins.offset_by_bound.add(seed, offset_bound, offset, offset_bound);
    bins.angle_by_bound.add(seed, angle_bound, angle, angle_bound);
  }
}

/// The matched poses of one pipeline: position and heading in the bins of offset and angle.
void add_poses(const runs::StoredFiles& cell, std::uint64_t seed, MatchBins& bins) {
  if (!cell.has("pose_errors.csv")) return;
  const io::CsvTable csv =
      cell.table("pose_errors.csv", {"x_m", "y_m", "yaw_rad", "bound_position_m", "bound_yaw_rad"});
  for (std::size_t r = 0; r < csv.rows(); ++r) {
    const double position_bound = 100.0 * csv.number(r, "bound_position_m");
    const double heading_bound = degrees(csv.number(r, "bound_yaw_rad"));
    const double position = 100.0 * std::hypot(csv.number(r, "x_m"), csv.number(r, "y_m"));
    bins.offset_by_bound.add(seed, position_bound, position, position_bound);
    bins.angle_by_bound.add(seed, heading_bound, degrees(csv.number(r, "yaw_rad")), heading_bound);
  }
}

/// Only cells with the example's noise enter the curves over range, because other noise would hide the effect of range.
MatchBins load_matches(const runs::RunStore& store, const std::vector<study::Scenario>& scenarios,
                       const std::string& pipeline, const std::vector<std::uint64_t>& seeds, double noise, bool poses) {
  MatchBins bins;
  for (const auto& scenario : scenarios)
    for (const std::uint64_t seed : seeds) {
      const runs::StoredFiles cell = store.files({scenario.name, pipeline, seed});
      if (poses)
        add_poses(cell, seed, bins);
      else
        add_matches(cell, seed, noise_m(scenario) == noise, bins);
    }
  return bins;
}

enum class Against { range, bound };

FacetCurve curve_of(const std::vector<ErrorPoint>& points, Against against) {
  FacetCurve curve;
  for (const ErrorPoint& p : points) {
    const double x = against == Against::range ? p.x : p.bound;
    curve.points.emplace_back(x, p.rms);
    curve.intervals.push_back({x, p.low, p.high});
  }
  return curve;
}

std::vector<Vec2> bound_curve(const std::vector<ErrorPoint>& points) {
  std::vector<Vec2> curve;
  curve.reserve(points.size());
  for (const ErrorPoint& p : points) curve.emplace_back(p.x, p.bound);
  return curve;
}

/// 1, 2, 5 times powers of ten.
std::vector<std::pair<double, std::string>> round_ticks(double low, double high) {
  std::vector<std::pair<double, std::string>> ticks;
  for (const Tick& tick : decade_ticks(low, high)) ticks.emplace_back(tick.value, fmt::format("{:.3g}", tick.value));
  return ticks;
}

const study::Scenario& example_of(const std::vector<study::Scenario>& scenarios, const study::BenchmarkSpec& spec) {
  return *std::ranges::find(scenarios, spec.example, &study::Scenario::name);
}

class Drawer {
 public:
  Drawer(const runs::RunStore& store, const std::vector<study::Scenario>& scenarios, const study::BenchmarkSpec& spec,
         const FigureOptions& options)
      : store_(store),
        scenarios_(scenarios),
        options_(options),
        rows_(runs::load_summary(store.run() / runs::kSummaryFile)),
        seeds_(seeds_of(rows_)),
        subject_(spec.subject()),
        example_(example_of(scenarios, spec)) {
    for (const auto& ranked : rank_pipelines(scenarios, rows_, spec)) names_.push_back(ranked.name);
  }

  std::vector<FigureFile> draw(const std::function<void(double, const std::string&)>& progress) {
    const auto step = [&](double share, const std::string& what) {
      if (progress) progress(share, what);
    };
    if (!subject_.over_start.empty()) {
      step(0.0, "basin");
      draw_over_start();
      return std::move(files_);
    }
    const std::string& rank = subject_.rank_column().metric;
    step(0.0, rank + "_noise");
    if (rank == "f1")
      draw_f1();
    else
      draw_rank_over_noise();
    for (std::size_t i = 0; i < names_.size(); ++i) {
      step(0.1 + 0.6 * static_cast<double>(i) / static_cast<double>(names_.size()), "matches of " + names_[i]);
      bins_.push_back(load_matches(store_, scenarios_, names_[i], seeds_, noise_m(example_), !subject_.shows_example));
    }
    if (subject_.shows_example) {
      step(0.7, "error_range");
      draw_errors_over_range();
    }
    step(0.8, "error_bound");
    draw_errors_over_bound();
    if (subject_.shows_example) {
      step(0.9, "scan_overlay");
      draw_example();
    }
    return std::move(files_);
  }

 private:
  void write(const std::string& name, const std::string& caption, const FacetChart& chart) {
    write_figure(figure_folder(store_.run(), options_), "benchmark_" + name, render::facet_scene(chart), caption,
                 options_);
    files_.push_back({"benchmark", "benchmark_" + name, caption});
  }

  using ShownInterval = std::array<double, 3>;  // value, low, high

  /// A column against the noise, one panel per pipeline. `shown` scales an interval to the axis, or leaves it out.
  FacetChart chart_over_noise(const study::BenchmarkColumn& column, const std::string& title, const std::string& label,
                              const std::function<std::optional<ShownInterval>(const MeanInterval&)>& shown) const {
    FacetChart chart{.title = title,
                     .x = {.label = "σ of a range [cm]"},
                     .y = {.label = label, .log = true, .ticks = round_ticks(1e-3, 5e6)},
                     .curve_names = {"this " + subject_.noun},
                     .others_name = "the others"};
    const CellValues values = values_of(rows_, column.metric);
    std::map<double, std::vector<std::string>> scenarios;  // by noise
    for (const auto& scenario : scenarios_) scenarios[noise_m(scenario)].push_back(scenario.name);
    for (const auto& [noise, names] : scenarios)
      chart.x.ticks.emplace_back(100 * noise, fmt::format("{:.3g}", 100 * noise));
    for (const auto& pipeline : names_) {
      FacetCurve curve;
      for (const auto& [noise, names] : scenarios) {
        const auto interval = shown(mean_interval(per_seed(values, pipeline, seeds_, names, column.geometric)));
        if (!interval) continue;
        const auto& [value, low, high] = *interval;
        curve.points.emplace_back(100 * noise, value);
        curve.intervals.push_back({100 * noise, low, high});
      }
      chart.facets.push_back({pipeline, {curve}, {}});
    }
    chart.y.range = log_range(chart.facets, 1);
    return chart;
  }

  void draw_f1() {
    const auto to_perfect = [](const MeanInterval& f1) -> std::optional<ShownInterval> {
      return ShownInterval{100 * (1 - f1.mean), std::max(1e-3, 100 * (1 - f1.high)), 100 * (1 - f1.low)};
    };
    write(
        "f1_noise",
        "F1 against the standard deviation of the readings, as its difference to 100 %, lower is better: mean over "
        "worlds and sensors, bars are 95 % intervals over the seeds. Every panel shows the other extractors in grey; "
        "panels are in the order of rank.",
        chart_over_noise(subject_.rank_column(), "F1 against noise: difference to 100 %", "100 − F1 [%]", to_perfect));
  }

  /// The metric that decides the rank, one of those that span decades.
  void draw_rank_over_noise() {
    const study::BenchmarkColumn& rank = subject_.rank_column();
    const auto scaled = [&](const MeanInterval& interval) -> std::optional<ShownInterval> {
      if (!(interval.mean > 0)) return std::nullopt;
      const double value = rank.scale * interval.mean, low = rank.scale * interval.low;
      return ShownInterval{value, low > 0 ? low : 0.1 * value, rank.scale * interval.high};
    };
    FacetChart chart = chart_over_noise(rank, rank.head + " against noise", rank.head, scaled);
    if (rank.metric == subject_.bound.metric) {  // where the best possible is
      chart.reference_name = "the bound, the best possible";
      for (Facet& facet : chart.facets)
        facet.reference = {Vec2(chart.x.ticks.front().first, 1.0), Vec2(chart.x.ticks.back().first, 1.0)};
      chart.y.range = log_range(chart.facets, 1);
    }
    // Powers of ten alone: the labels of all ticks would touch.
    if (chart.y.range->second > 1e3 * chart.y.range->first) chart.y.ticks.clear();
    write(rank.metric + "_noise",
          rank.head +
              " against the standard deviation of the readings, lower is better: mean over the conditions, bars "
              "are 95 % intervals over the seeds. In every panel the others in grey; panels in the order of rank.",
          chart);
  }

  void draw_over_start() {
    const auto column = std::ranges::find(subject_.columns, subject_.over_start, &study::BenchmarkColumn::metric);
    write("basin",
          fmt::format("Basin of convergence: {} against the standard deviation of the errors of the given poses, mean "
                      "over worlds and numbers of scans; bars are 95 % intervals over the {} seeds. Panels are in the "
                      "order of rank.",
                      column->definition, seeds_.size()),
          basin_chart(scenarios_, rows_, names_, *column));
  }

  void draw_errors_over_range() {
    const auto chart_of = [&](const std::string& what, const std::string& unit, ErrorBins MatchBins::*bins) {
      FacetChart chart{.title = what + " error against range",
                       .x = {.label = "range [m]", .log = true, .ticks = round_ticks(0.1, 500.0)},
                       .y = {.label = "rms error [" + unit + "]", .log = true},
                       .curve_names = {"this extractor"},
                       .reference_name = "Cramér–Rao bound of its lines",
                       .others_name = "the others"};
      for (std::size_t i = 0; i < names_.size(); ++i) {
        const auto points = (bins_[i].*bins).points(kLeastMatches);
        chart.facets.push_back({names_[i], {curve_of(points, Against::range)}, bound_curve(points)});
      }
      chart.x.range = log_range(chart.facets, 0);
      chart.y.range = log_range(chart.facets, 1);
      return chart;
    };
    const std::string caption = fmt::format(
        "error of matched lines with 20 returns or more against the range of the line's midpoint, noise {:.3g} cm, all "
        "worlds and sensors. Root mean square in bins of a third of an octave with at least {} lines, geometric mean "
        "over "
        "the seeds with its 95 % interval. Dotted: the bound of the same lines.",
        100 * noise_m(example_), kLeastMatches);
    write("offset_range", "Offset " + caption, chart_of("Offset", "cm", &MatchBins::offset_by_range));
    write("angle_range", "Angle " + caption, chart_of("Angle", "°", &MatchBins::angle_by_range));
  }

  void draw_errors_over_bound() {
    FacetChart chart{.title = "Errors against their bound",
                     .x = {.label = "√bound [cm], [°]", .log = true},
                     .y = {.label = "error [cm], [°]", .log = true},
                     .curve_names = subject_.shows_example ? std::vector<std::string>{"offset [cm]", "angle [°]"}
                                                           : std::vector<std::string>{"position [cm]", "heading [°]"},
                     .reference_name = "error = bound"};
    for (std::size_t i = 0; i < names_.size(); ++i)
      chart.facets.push_back({names_[i],
                              {curve_of(bins_[i].offset_by_bound.points(kLeastMatches), Against::bound),
                               curve_of(bins_[i].angle_by_bound.points(kLeastMatches), Against::bound)},
                              {}});
    chart.x.range = log_range(chart.facets, 0);
    chart.y.range = log_range(chart.facets, 1);
    for (Facet& facet : chart.facets)
      facet.reference = {Vec2::Constant(chart.x.range->first), Vec2::Constant(chart.x.range->second)};
    chart.y.range->first = std::min(chart.y.range->first, chart.x.range->first);
    write("error_bound",
          fmt::format(
              "Errors of {} against the root of their Cramér–Rao bound, all conditions: root mean square in bins of a "
              "quarter of a decade with at least {} of them, geometric mean over the seeds with its 95 % interval. On "
              "the dotted line {} reaches the bound.",
              subject_.shows_example ? "matched lines with 20 returns or more" : "matched poses", kLeastMatches,
              subject_.shows_example ? "an extractor" : "a matcher"),
          chart);
  }

  void draw_example() {
    study::Scenario scenario = example_;
    std::ranges::sort(scenario.pipelines, {},
                      [&](const study::PipelineSpec& p) { return std::ranges::find(names_, p.name) - names_.begin(); });
    const ParamSet params = resolve(Registry<render::Figure>::all().at("scan_overlay").params, {});
    scenario.figures = {{"figure", "scan_overlay", params}};
    for (auto& figure : draw_figures(store_, scenario, options_)) files_.push_back(std::move(figure));
  }

  const runs::RunStore& store_;
  const std::vector<study::Scenario>& scenarios_;
  const FigureOptions& options_;
  std::vector<runs::SummaryRow> rows_;
  std::vector<std::uint64_t> seeds_;
  const study::BenchmarkSubject& subject_;
  const study::Scenario& example_;
  std::vector<std::string> names_;  ///< of the pipelines, by rank
  std::vector<MatchBins> bins_;     ///< as names_
  std::vector<FigureFile> files_;
};

}  // namespace

std::vector<FigureFile> draw_benchmark_figures(const runs::RunStore& store,
                                               const std::vector<study::Scenario>& scenarios,
                                               const study::BenchmarkSpec& spec, const FigureOptions& options,
                                               const std::function<void(double, const std::string&)>& progress) {
  return Drawer(store, scenarios, spec, options).draw(progress);
}

}  // namespace scanbench::results
