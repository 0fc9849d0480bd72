// Compares the accuracy of an extractor on simulated rooms with that of an oracle that knows which beams see which
// wall. The difference is the cost of not knowing. Prints the table of docs/algorithms/optimal.md.
//
//   optimal_accuracy [--seeds FIRST COUNT] [--sigma CM] [--scene PART_OF_NAME] [--world FILE]... [--scans N]
//                    [--extractor NAME] [--why]
//
// --world takes files of worlds (vector maps, for example) in place of the scenes; --scans is per seed.
// Uses the metrics `segments` and `efficiency` with their defaults: a run of beams on one wall is a true line from 9
// returns and 0.5 m on. The second F1 ignores correct lines on smaller pieces. --why classifies all wrong lines. Seeds
// below 100 are for development.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "algorithms/extract/parts/beam_line.hpp"
#include "bench/accuracy/scenes.hpp"
#include "core/index.hpp"
#include "core/modules.hpp"
#include "core/registry.hpp"
#include "metrics/line_matching.hpp"

namespace scanbench::accuracy {
namespace {

using metrics::MetricInput;
using metrics::Outcome;

// True runs of beams, each with its maximum-likelihood line.
ScanLines oracle_lines(const MetricInput& input, std::size_t frame, const metrics::Surfaces& surfaces) {
  const Scan scan = input.observed.scan(frame);
  ScanLines out;
  out.labels.assign(as_index(scan.beams()), -1);
  for (const metrics::TrueLine& t : metrics::true_lines(input, frame, surfaces, {})) {
    std::vector<extract::BeamReading> readings;
    for (int i = t.first_beam; i <= t.last_beam; ++i)
      if (scan.valid(i)) readings.push_back({scan.sensor.geometry.direction(i), scan.ranges[as_index(i)]});
    const auto fit = extract::fit_beam_line(readings, scan.sensor.noise);
    if (!fit) continue;
    LineFeature line;
    line.segment = {fit->range(readings.front().direction) * readings.front().direction,
                    fit->range(readings.back().direction) * readings.back().direction};
    line.line = canonical(fit->rho(), std::atan2(fit->theta.y(), fit->theta.x()));
    line.covariance = extract::line_covariance(*fit, line.segment.midpoint());
    line.first_beam = t.first_beam;
    line.last_beam = t.last_beam;
    line.points = static_cast<int>(readings.size());
    out.lines.push_back(line);
  }
  return out;
}

// Counts false and missed lines by their causes.
class Reasons {
 public:
  void add(const MetricInput& input, std::size_t f, const metrics::Surfaces& surfaces) {
    const ScanLines& found = input.result.lines[f];
    const auto truths = metrics::true_lines(input, f, surfaces, {});
    const auto pieces = metrics::true_lines(input, f, surfaces, {.min_beams = 3, .min_length_m = 0.0});
    const auto matching = metrics::match_lines(found.lines, truths, {});
    std::vector<bool> taken(truths.size(), false);
    for (std::size_t k = 0; k < found.lines.size(); ++k) {
      if (matching.outcome[k] == Outcome::true_line) taken[as_index(matching.truth[k])] = true;
      if (matching.outcome[k] != Outcome::false_line) continue;
      ++count_["false: " + of_false(found, static_cast<int>(k), pieces, surfaces)];
    }
    for (std::size_t t = 0; t < truths.size(); ++t)
      if (!taken[t]) ++count_["missed: " + of_missed(input.observed.scan(f), found, truths[t])];
  }
  void print() const {
    for (const auto& [reason, n] : count_) fmt::print("    {:5} {}\n", n, reason);
  }

 private:
  static std::string of_false(const ScanLines& found, int k, const std::vector<metrics::TrueLine>& pieces,
                              const metrics::Surfaces& surfaces) {
    const LineFeature& line = found.lines[as_index(k)];
    // Number of returns of the line on each piece.
    int most = 0, coplanar = 0;
    const metrics::TrueLine* main = nullptr;
    const auto support = [&](const metrics::TrueLine& p) {
      int n = 0;
      for (int i = p.first_beam; i <= p.last_beam; ++i) n += found.labels[as_index(i)] == k;
      return n;
    };
    for (const auto& p : pieces)
      if (support(p) > most) most = support(p), main = &p;
    if (!main) return "on runs of one or two returns";
    const Segment& wall = surfaces.segments[as_index(main->surface)];
    for (const auto& p : pieces) {
      const Segment& other = surfaces.segments[as_index(p.surface)];
      if (std::fabs(cross(wall.direction(), other.a - wall.a)) < 1e-3 &&
          std::fabs(cross(wall.direction(), other.b - wall.a)) < 1e-3)
        coplanar += support(p);
    }
    if (coplanar > most && coplanar >= 0.8 * line.points) return "over coplanar pieces with nothing seen between them";
    const metrics::TrueLine one[] = {*main};
    const std::vector<LineFeature> self = {line};
    const bool right = metrics::match_lines(self, one, {}).outcome[0] == Outcome::true_line;
    if (main->beams < 9 || main->segment.length() < 0.5)
      return std::string(right ? "right line" : "wrong line") +
             (main->beams < 9 ? " on a piece of fewer than 9 returns" : " on a piece shorter than 0.5 m");
    return most >= 0.8 * line.points ? "one wall, badly fitted" : "over several walls";
  }
  static std::string of_missed(const Scan& scan, const ScanLines& found, const metrics::TrueLine& t) {
    std::map<int, int> by_line;
    int on_lines = 0;
    for (int i = t.first_beam; i <= t.last_beam; ++i) {
      const int k = found.labels[as_index(i)];
      if (k >= 0) ++by_line[k], ++on_lines;
    }
    int most = 0, which = -1;
    for (const auto& [k, n] : by_line)
      if (n > most) most = n, which = k;
    const std::string size = t.beams < 14 ? " (9 to 13 returns)" : "";
    if (2 * on_lines < t.beams) return "not on any line" + size;
    const int other = found.lines[as_index(which)].points - most;
    if (other <= most) return "its line does not match" + size;
    const double gain = gain_of_a_cut(scan, found, which, t);
    return (gain < std::log(static_cast<double>(scan.beams())) ? "one line fits it and its neighbour as well as two"
                                                               : "taken by a line of another wall") +
           size;
  }
  // The gain in log-likelihood (nats) if the readings on the true line get a line of their own. A cut that gains less
  // than the code length of its place cannot be found from the readings.
  static double gain_of_a_cut(const Scan& scan, const ScanLines& found, int which, const metrics::TrueLine& t) {
    std::vector<extract::BeamReading> all, on, off;
    for (int i = 0; i < scan.beams(); ++i) {
      if (found.labels[as_index(i)] != which) continue;
      all.push_back({scan.sensor.geometry.direction(i), scan.ranges[as_index(i)]});
      (t.first_beam <= i && i <= t.last_beam ? on : off).push_back(all.back());
    }
    return half_squares(all, scan) - half_squares(on, scan) - half_squares(off, scan);
  }
  static double half_squares(std::span<const extract::BeamReading> readings, const Scan& scan) {
    const auto line = extract::fit_beam_line(readings, scan.sensor.noise);
    double sum = 0.0;
    for (const extract::BeamReading& b : readings)
      if (line)
        sum += 0.5 * std::pow((b.range_m - line->range(b.direction)) / scan.sensor.noise.range_sigma(b.range_m), 2);
    return sum;
  }

  std::map<std::string, int> count_;
};

// Sums of two metric families over several recordings.
class Score {
 public:
  void add(const MetricInput& input) {
    std::map<std::string, metrics::MetricRow> row;
    for (const char* family : {"segments", "efficiency"})
      for (const metrics::MetricRow& r : Registry<metrics::MetricFamily>::make(family)->evaluate(input))
        row[r.metric] = r;
    for (const char* n : {"n_true", "n_false", "n_small", "n_split", "n_missed"}) sum_[n] += row[n].value;
    if (row["nees"].count > 0) {
      sum_["nees"] += row["nees"].value * static_cast<double>(row["nees"].count);
      sum_["nees_count"] += static_cast<double>(row["nees"].count);
    }
    for (const std::string what : {"offset", "angle"}) {
      const metrics::MetricRow& bound = row["bound_" + what];
      if (bound.count == 0) continue;
      const double bounds = bound.value * bound.value * static_cast<double>(bound.count);
      sum_["bound_" + what] += bounds;
      sum_[what] += bounds * row["efficiency_" + what].value;
    }
  }
  void print(const std::string& scene, double sigma_m, const std::string& name) {
    const double found = sum_["n_true"] + sum_["n_false"] + sum_["n_split"];
    const double both = found + sum_["n_true"] + sum_["n_missed"];
    fmt::print(
        "| {} | {:g} cm | {} | {:.4f} | {:.4f} | {:.2f} % | {:.2f} % | {:.2f}, {:.2f} | {:.2f} (2 +- {:.2f}) |\n",
        scene, 100 * sigma_m, name, 2 * sum_["n_true"] / (both + sum_["n_small"]), 2 * sum_["n_true"] / both,
        100 * (sum_["n_false"] + sum_["n_small"]) / (found + sum_["n_small"]),
        100 * sum_["n_split"] / (found + sum_["n_small"]), sum_["offset"] / sum_["bound_offset"],
        sum_["angle"] / sum_["bound_angle"], sum_["nees"] / sum_["nees_count"],
        1.96 * 2 / std::sqrt(sum_["nees_count"]));
    std::fflush(stdout);
  }

 private:
  std::map<std::string, double> sum_;
};

struct Options {
  std::uint64_t first_seed = 101;
  std::uint64_t seeds = 3;
  std::vector<double> sigmas_m = {0.01, 0.05};
  std::string scene;
  std::vector<std::filesystem::path> worlds;
  int scans = 0;  ///< per seed; 0: as many as the scene says
  std::string extractor = "optimal";
  bool why = false;
};

void measure(const Scene& scene, double sigma_m, const Options& options) {
  const auto extractor = Registry<LineExtractor>::make(options.extractor);
  Score score, oracle;
  Reasons reasons;
  for (std::uint64_t seed = options.first_seed; seed < options.first_seed + options.seeds; ++seed)
    for (const Recording& recording : recordings(scene, sigma_m, seed)) {
      const metrics::Surfaces surfaces = metrics::join_walls(recording.truth->walls);
      PipelineResult found, told;
      const MetricInput input{recording.observed, &*recording.truth, found};
      const MetricInput oracle_input{recording.observed, &*recording.truth, told};
      Trace silent;
      for (std::size_t f = 0; f < recording.observed.frames.size(); ++f) {
        found.lines.push_back(extractor->extract(recording.observed.scan(f), silent));
        told.lines.push_back(oracle_lines(oracle_input, f, surfaces));
        reasons.add(input, f, surfaces);
      }
      score.add(input);
      oracle.add(oracle_input);
    }
  score.print(scene.name, sigma_m, options.extractor);
  oracle.print(scene.name, sigma_m, "oracle");
  if (options.why) reasons.print();
}

std::vector<Scene> scenes_of(const Options& options) {
  std::vector<Scene> result;
  for (const std::filesystem::path& file : options.worlds) {
    const std::string name = file.filename().string();
    result.push_back({.name = name.substr(0, name.find('.')), .file = file.string()});
  }
  if (!result.empty()) return result;
  for (const Scene& scene : scenes())
    if (scene.name.find(options.scene) != std::string::npos) result.push_back(scene);
  return result;
}

int run(std::span<char*> args) {
  Options options;
  for (std::size_t i = 1; i < args.size(); ++i) {
    const std::string arg = args[i];
    const auto left = args.size() - i - 1;
    if (arg == "--why") {
      options.why = true;
    } else if (arg == "--seeds" && left >= 2) {
      options.first_seed = std::strtoull(args[++i], nullptr, 10);
      options.seeds = std::strtoull(args[++i], nullptr, 10);
    } else if (arg == "--sigma" && left >= 1) {
      options.sigmas_m = {0.01 * std::strtod(args[++i], nullptr)};
    } else if (arg == "--scene" && left >= 1) {
      options.scene = args[++i];
    } else if (arg == "--world" && left >= 1) {
      options.worlds.emplace_back(std::filesystem::absolute(args[++i]));
    } else if (arg == "--scans" && left >= 1) {
      options.scans = std::atoi(args[++i]);
    } else if (arg == "--extractor" && left >= 1) {
      options.extractor = args[++i];
    } else {
      fmt::print(stderr,
                 "{}: unknown argument; allowed: --seeds FIRST COUNT, --sigma CM, --scene PART_OF_NAME, --world FILE, "
                 "--scans N, --extractor NAME, --why\n",
                 arg);
      return 2;
    }
  }
  fmt::print(
      "| scene | noise | extractor | F1 | F1, small pieces ignored | false | split | offset, angle MSE / bound | NEES "
      "(band) "
      "|\n");
  fmt::print("|---|---|---|---|---|---|---|---|---|\n");
  for (const double sigma_m : options.sigmas_m)
    for (Scene scene : scenes_of(options)) {
      if (options.scans > 0) scene.scans = options.scans;
      measure(scene, sigma_m, options);
    }
  return 0;
}

}  // namespace
}  // namespace scanbench::accuracy

int main(int argc, char** argv) {
  return scanbench::accuracy::run({argv, scanbench::as_index(argc)});
}
