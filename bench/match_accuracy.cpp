// How near matched poses come to their bounds: scans in pairs, a step of up to 0.3 m and 10 degrees apart, in the
// worlds of bench/accuracy and in vector maps; the guess is off by 5 cm along each axis and 2 degrees, signs at random.
// And whether matchers know a corridor without end. Prints Markdown tables. --oracle adds rows of an oracle that knows
// which beams see which wall: its MSE over the bound differs from 1 only because the pairs are a sample.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <Eigen/Eigenvalues>

#include "bench/accuracy/pose_oracle.hpp"
#include "bench/accuracy/scenes.hpp"
#include "core/modules.hpp"
#include "core/registry.hpp"
#include "core/rng.hpp"
#include "metrics/metric.hpp"
#include "sim/sensors.hpp"
#include "sim/simulate.hpp"

namespace scanbench::accuracy {
namespace {

struct Options {
  std::uint64_t first_seed = 101;
  std::uint64_t seeds = 2;
  std::vector<double> sigmas_m = {0.01, 0.05};
  std::string scene;
  std::string maps;
  std::string extractor = "optimal";
  std::vector<std::string> matchers = {"icp", "plicp", "optimal_match"};
  int pairs = 150;
  double start_m = 0.05;
  double start_deg = 2.0;
  bool corridor = false;
  bool oracle = false;
  bool worst = false;
};

/// The true step with an error along both axes and of the heading, signs at random.
Pose2 wrong_by_a_start_error(const Pose2& step, const Options& options, std::uint64_t seed, std::size_t pair) {
  CounterRng rng(seed, RngStream::odometry, static_cast<std::uint32_t>(pair));
  const auto sign = [&] { return rng.uniform() < 0.5 ? -1.0 : 1.0; };
  const double x = options.start_m * sign(), y = options.start_m * sign();
  return {step.x() + x, step.y() + y, step.yaw() + radians(options.start_deg) * sign()};
}

std::vector<ScanLines> lines_of(const ScanSet& scans, const std::string& extractor) {
  const auto module = Registry<LineExtractor>::make(extractor);
  Trace silent;
  std::vector<ScanLines> lines;
  for (std::size_t k = 0; k < scans.frames.size(); ++k) lines.push_back(module->extract(scans.scan(k), silent));
  return lines;
}

std::vector<FrameMatch> match_pairs(const ScanMatcher& matcher, const Recording& recording,
                                    const std::vector<ScanLines>& lines, const Options& options, std::uint64_t seed) {
  std::vector<FrameMatch> matches;
  Trace silent;
  const auto& poses = recording.truth->world_from_sensor;
  for (std::size_t k = 0; k + 1 < lines.size(); k += 2) {
    const Scan reference = recording.observed.scan(k), current = recording.observed.scan(k + 1);
    const Pose2 guess = wrong_by_a_start_error(poses[k].inverse() * poses[k + 1], options, seed, k / 2);
    matches.push_back({static_cast<int>(k) + 1, static_cast<int>(k),
                       matcher.match({reference, lines[k]}, {current, lines[k + 1]}, guess, silent)});
  }
  return matches;
}

std::vector<FrameMatch> oracle_pairs(const metrics::MetricInput& input) {
  const metrics::Surfaces surfaces = metrics::join_walls(input.truth->walls);
  std::vector<FrameMatch> matches;
  for (std::size_t k = 0; k + 1 < input.observed.frames.size(); k += 2) {
    const Match none{Status::no_match, {}, Eigen::Matrix3d::Zero()};
    matches.push_back(
        {static_cast<int>(k) + 1, static_cast<int>(k), oracle_match(input, surfaces, k, k + 1).value_or(none)});
  }
  return matches;
}

/// Rows of `pose_efficiency` over several recordings.
class Score {
 public:
  void add(const metrics::MetricInput& input) {
    std::map<std::string, metrics::MetricRow> row;
    for (const metrics::MetricRow& r : Registry<metrics::MetricFamily>::make("pose_efficiency")->evaluate(input))
      row[r.metric] = r;
    for (const std::string name :
         {"pose_error_position", "pose_error_heading", "pose_bound_position", "pose_bound_heading"})
      if (row[name].count > 0) add_mean(name, row[name].value * row[name].value, row[name].count);
    for (const std::string name : {"pose_nees", "pose_unmatched", "pose_unobservable", "pose_open_found"})
      if (row[name].count > 0) add_mean(name, row[name].value, row[name].count);
    for (const std::string what : {"position", "heading"}) {
      if (row["pose_error_" + what].count == 0) continue;
      const double square = std::pow(row["pose_error_" + what].value, 2);
      add_mean("known_" + what, square / row["pose_known_map_" + what].value, row["pose_error_" + what].count);
    }
  }
  void print(const std::string& scene, double sigma_m, const std::string& matcher) const {
    const auto ratio = [&](const std::string& what) { return mean("pose_error_" + what) / mean("pose_bound_" + what); };
    const auto known = [&](const std::string& what) { return mean("pose_error_" + what) / mean("known_" + what); };
    fmt::print(
        "| {} | {:g} cm | {} | {} | {:.2f} mm, {:.4f} deg | {:.2f} mm, {:.4f} deg | {:.2f}, {:.2f} | {:.2f}, {:.2f} | "
        "{:.2f} (3 +- {:.2f}) | {:.1f} % | {:.1f} % of {:.1f} % |\n",
        scene, 100 * sigma_m, matcher, count("pose_error_position"), 1e3 * std::sqrt(mean("pose_error_position")),
        std::sqrt(mean("pose_error_heading")), 1e3 * std::sqrt(mean("pose_bound_position")),
        std::sqrt(mean("pose_bound_heading")), ratio("position"), ratio("heading"), known("position"), known("heading"),
        mean("pose_nees"), 1.96 * std::sqrt(6.0 / static_cast<double>(count("pose_nees"))),
        100 * mean("pose_unmatched"), 100 * mean("pose_open_found"), 100 * mean("pose_unobservable"));
    std::fflush(stdout);
  }

 private:
  void add_mean(const std::string& name, double value, std::int64_t observations) {
    sums_[name].first += value * static_cast<double>(observations);
    sums_[name].second += observations;
  }
  double mean(const std::string& name) const {
    const auto found = sums_.find(name);
    return found == sums_.end() ? NAN : found->second.first / static_cast<double>(found->second.second);
  }
  std::int64_t count(const std::string& name) const {
    const auto found = sums_.find(name);
    return found == sums_.end() ? 0 : found->second.second;
  }
  std::map<std::string, std::pair<double, std::int64_t>> sums_;
};

/// The pairs with the largest errors over their bounds.
void print_worst(const metrics::MetricInput& input) {
  const auto family = Registry<metrics::MetricFamily>::make("pose_efficiency", {{"errors", true}});
  const std::vector<metrics::MetricTable> tables = family->tables(input);
  std::vector<std::pair<double, std::vector<double>>> rows;
  for (const auto& row : tables.front().rows)
    rows.emplace_back(std::max(std::hypot(row[2], row[3]) / row[5], std::fabs(row[4]) / row[6]), row);
  std::ranges::sort(rows, std::greater<>{}, [](const auto& r) { return r.first; });
  for (std::size_t k = 0; k < std::min<std::size_t>(rows.size(), 5); ++k) {
    const auto& r = rows[k].second;
    fmt::print("    frame {}: {:.1f} times; {:.4f} m {:.4f} m {:.4f} deg; bound {:.4f} m {:.4f} deg\n", r[0],
               rows[k].first, r[2], r[3], degrees(r[4]), r[5], degrees(r[6]));
  }
}

void measure(const Scene& scene, double sigma_m, const Options& options) {
  std::map<std::string, Score> scores;
  for (std::uint64_t seed = options.first_seed; seed < options.first_seed + options.seeds; ++seed)
    for (const Recording& recording : recordings(scene, sigma_m, seed)) {
      const std::vector<ScanLines> lines = lines_of(recording.observed, options.extractor);
      for (const std::string& name : options.matchers) {
        PipelineResult result;
        result.lines = lines;
        result.matches = match_pairs(*Registry<ScanMatcher>::make(name), recording, lines, options, seed);
        const metrics::MetricInput input{recording.observed, &*recording.truth, result};
        scores[name].add(input);
        if (options.worst) print_worst(input);
      }
      if (!options.oracle) continue;
      PipelineResult result;
      result.lines = lines;
      const metrics::MetricInput input{recording.observed, &*recording.truth, result};
      result.matches = oracle_pairs(input);
      scores["oracle"].add(input);
    }
  for (const std::string& name : options.matchers) scores[name].print(scene.name, sigma_m, name);
  if (options.oracle) scores["oracle"].print(scene.name, sigma_m, "oracle");
}

/// Pairs in a corridor of 2 m whose ends are beyond the sensor's range.
Recording corridor(double sigma_m, std::uint64_t seed, int pairs) {
  sim::SimulationInput input;
  input.world.walls = {{"left", {{200, 1}, {-200, 1}}}, {"right", {{-200, -1}, {200, -1}}}};
  input.sensor = sim::make_sensor("ladar_2d30", {{"sigma_m", sigma_m}});
  input.trajectory.continuous = false;
  CounterRng rng(seed, RngStream::pose);
  const auto about = [&](double most) { return most * (2.0 * rng.uniform() - 1.0); };
  for (int k = 0; k < pairs; ++k) {
    const Pose2 pose(about(1.0), about(0.5), about(kPi));
    for (const Pose2& p : {pose, pose * Pose2(about(0.2), about(0.2), about(radians(10)))})
      input.trajectory.poses.push_back({static_cast<double>(input.trajectory.poses.size()), p});
  }
  input.seed = seed;
  return sim::simulate(input);
}

void measure_corridor(double sigma_m, const Options& options) {
  const Recording recording = corridor(sigma_m, options.first_seed, 4 * options.pairs);
  const std::vector<ScanLines> lines = lines_of(recording.observed, options.extractor);
  for (const std::string& name : options.matchers) {
    const auto matches = match_pairs(*Registry<ScanMatcher>::make(name), recording, lines, options, options.first_seed);
    int degenerate = 0, no_match = 0, named = 0;
    double largest = 0.0;
    for (const FrameMatch& m : matches) {
      no_match += m.match.status == Status::no_match;
      if (m.match.status != Status::degenerate) continue;
      ++degenerate;
      const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(m.match.covariance);
      const Vec2 direction = eigen.eigenvectors().col(2).head<2>();
      const Pose2& pose = recording.truth->world_from_sensor[static_cast<std::size_t>(m.reference)];
      const double off = degrees(std::fabs(wrap_direction(std::atan2(direction.y(), direction.x()) + pose.yaw())));
      named += off <= 2.0;
      largest = std::max(largest, off);
    }
    fmt::print(
        "| corridor | {:g} cm | {} | {} | {:.2f} % degenerate, {} no_match | {:.2f} % named within 2 deg, worst {:.2f} "
        "deg |\n",
        100 * sigma_m, name, matches.size(), 100.0 * degenerate / static_cast<double>(matches.size()), no_match,
        100.0 * named / std::max(degenerate, 1), largest);
  }
}

std::vector<Scene> scenes_to_measure(const Options& options) {
  std::vector<Scene> all;
  if (options.maps.empty()) {
    all = scenes();
  } else {
    for (const auto& entry : std::filesystem::directory_iterator(options.maps))
      if (entry.path().string().find(".vectormap.txt") != std::string::npos)
        all.push_back({.name = entry.path().filename().string().substr(0, entry.path().filename().string().find('.')),
                       .file = entry.path().string(),
                       .least_returns = 0.5});
    std::ranges::sort(all, {}, &Scene::name);
  }
  for (Scene& scene : all) {
    scene.in_pairs = true;
    scene.scans = 2 * options.pairs;
  }
  return all;
}

bool read(std::span<char*> args, Options& options) {
  for (std::size_t i = 1; i < args.size(); ++i) {
    const std::string arg = args[i];
    const auto left = args.size() - i - 1;
    if (arg == "--corridor") {
      options.corridor = true;
    } else if (arg == "--oracle") {
      options.oracle = true;
    } else if (arg == "--worst") {
      options.worst = true;
    } else if (arg == "--seeds" && left >= 2) {
      options.first_seed = std::strtoull(args[++i], nullptr, 10);
      options.seeds = std::strtoull(args[++i], nullptr, 10);
    } else if (arg == "--sigma" && left >= 1) {
      options.sigmas_m = {0.01 * std::strtod(args[++i], nullptr)};
    } else if (arg == "--pairs" && left >= 1) {
      options.pairs = std::atoi(args[++i]);
    } else if (arg == "--start" && left >= 2) {
      options.start_m = 0.01 * std::strtod(args[++i], nullptr);
      options.start_deg = std::strtod(args[++i], nullptr);
    } else if (arg == "--scene" && left >= 1) {
      options.scene = args[++i];
    } else if (arg == "--maps" && left >= 1) {
      options.maps = args[++i];
    } else if (arg == "--extractor" && left >= 1) {
      options.extractor = args[++i];
    } else if (arg == "--matcher" && left >= 1) {
      options.matchers = {args[++i]};
    } else {
      fmt::print(stderr,
                 "{}: not understood; allowed: --corridor, --maps FOLDER, --seeds FIRST COUNT, --sigma CM, --pairs N, "
                 "--start CM DEGREES, --scene PART_OF_NAME, --extractor NAME, --matcher NAME, --oracle, --worst\n",
                 arg);
      return false;
    }
  }
  return true;
}

int run(std::span<char*> args) {
  Options options;
  if (!read(args, options)) return 2;
  if (options.corridor) {
    fmt::print("| scene | noise | matcher | pairs | status | direction |\n|---|---|---|---|---|---|\n");
    for (const double sigma_m : options.sigmas_m) measure_corridor(sigma_m, options);
    return 0;
  }
  fmt::print(
      "| scene | noise | matcher | pairs | error | bound | MSE / bound | MSE / known map | NEES (band) | unmatched | "
      "open, found |\n|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (const double sigma_m : options.sigmas_m)
    for (const Scene& scene : scenes_to_measure(options))
      if (scene.name.find(options.scene) != std::string::npos) measure(scene, sigma_m, options);
  return 0;
}

}  // namespace
}  // namespace scanbench::accuracy

int main(int argc, char** argv) {
  return scanbench::accuracy::run({argv, static_cast<std::size_t>(argc)});
}
