// Time of line extraction in microseconds per 451-beam scan, for every registered extractor, on 200 poses in a 15-wall
// world with noise of 1 and 5 cm. For comparison, a textbook IEPF (recursion, copies, polar distances with
// trigonometry) runs on the same scans.
//
// With --ratios [rounds] the program prints rows of bench/ratios.hpp instead.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bench/ratios.hpp"
#include "core/index.hpp"
#include "core/modules.hpp"
#include "core/registry.hpp"
#include "core/rng.hpp"
#include "core/special_values.hpp"

namespace scanbench {
namespace {

constexpr int kPoses = 200;

std::vector<Segment> walls() {
  std::vector<Segment> result;
  const auto chain = [&](const std::vector<Vec2>& corners, bool closed) {
    for (std::size_t i = 0; i + 1 < corners.size() + (closed ? 1 : 0); ++i)
      result.push_back({corners[i], corners[(i + 1) % corners.size()]});
  };
  chain({{0, 0}, {12, 0}, {12, 5}, {8, 5}, {8, 9}, {0, 9}}, true);  // an L-shaped room
  chain({{3, 2}, {4, 2}, {4, 3}, {3, 3}}, true);                    // a box
  chain({{2, 6}, {3.2, 6.4}, {2.8, 7.4}, {1.6, 7}}, true);          // a rotated box
  result.push_back({{9, 2}, {10.5, 2.6}});                          // a panel
  return result;
}

/// Scans over 270 degrees in steps of 0.6 degrees, cast by brute force against every wall.
const ScanSet& scans(int sigma_cm) {
  static const auto make = [](double sigma_m) {
    ScanSet set;
    set.sensor.geometry = ScanGeometry(radians(-135), radians(0.6), 451);
    set.sensor.noise.sigma_m = sigma_m;
    const std::vector<Segment> world = walls();
    for (std::uint32_t f = 0; f < kPoses; ++f) {
      CounterRng place(1, RngStream::pose, f);
      const Pose2 pose(4.5 + 3.2 * place.uniform(), 0.6 + 7.0 * place.uniform(), kTwoPi * place.uniform());
      Frame frame;
      for (int i = 0; i < 451; ++i) {
        const Vec2 u = pose.rotate(set.sensor.geometry.direction(i));
        double r = kInf;
        for (const Segment& w : world) {
          const Vec2 d = w.b - w.a;
          const double det = cross(u, d);
          const double t = cross(w.a - pose.translation(), d) / det;
          const double s = cross(w.a - pose.translation(), u) / det;
          if (t > 0 && s >= 0 && s <= 1 && t < r) r = t;
        }
        frame.ranges.push_back(r +
                               sigma_m * CounterRng(2, RngStream::range, f, static_cast<std::uint32_t>(i)).normal());
      }
      set.frames.push_back(frame);
    }
    return set;
  };
  static const ScanSet one = make(0.01);
  static const ScanSet five = make(0.05);
  return sigma_cm == 1 ? one : five;
}

void run_module(benchmark::State& state, const std::string& name) {
  const ScanSet& set = scans(static_cast<int>(state.range(0)));
  const auto module = Registry<LineExtractor>::make(name);
  Trace silent;
  std::size_t lines = 0;
  for (auto _ : state) {
    lines = 0;
    for (std::size_t f = 0; f < set.frames.size(); ++f) lines += module->extract(set.scan(f), silent).lines.size();
    benchmark::DoNotOptimize(lines);
  }
  const double done = static_cast<double>(state.iterations()) * kPoses;
  state.counters["us_per_scan"] =
      benchmark::Counter(done * 1e-6, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["lines"] = static_cast<double>(lines) / kPoses;
}

// A direct implementation of the paper: a copy per recursion, the polar form of the chord for every test, a total
// least-squares fit with its angle for every group.
namespace textbook {

using Points = std::vector<Vec2>;

struct Line {
  double rho, alpha;
  Segment segment;
  Points support;
};

Line fit(const Points& p) {
  Vec2 c = Vec2::Zero();
  for (const Vec2& q : p) c += q;
  c /= static_cast<double>(p.size());
  double sxx = 0, sxy = 0, syy = 0;
  for (const Vec2& q : p) {
    sxx += (q.x() - c.x()) * (q.x() - c.x());
    sxy += (q.x() - c.x()) * (q.y() - c.y());
    syy += (q.y() - c.y()) * (q.y() - c.y());
  }
  const double alpha = 0.5 * std::atan2(-2 * sxy, syy - sxx);
  const double rho = c.x() * std::cos(alpha) + c.y() * std::sin(alpha);
  return {rho, alpha, {p.front(), p.back()}, p};
}

void split(const Points& p, double threshold, std::vector<Line>& lines) {
  if (p.size() > 2) {
    double best = -1;
    std::size_t far = 0;
    for (std::size_t k = 1; k + 1 < p.size(); ++k) {
      const double alpha = std::atan2(p.back().y() - p.front().y(), p.back().x() - p.front().x()) + kPi / 2;
      const double rho = p.front().x() * std::cos(alpha) + p.front().y() * std::sin(alpha);
      const double d = std::fabs(p[k].x() * std::cos(alpha) + p[k].y() * std::sin(alpha) - rho);
      if (d > best) {
        best = d;
        far = k;
      }
    }
    if (best > threshold) {
      const auto middle = p.begin() + static_cast<std::ptrdiff_t>(far);
      split(Points(p.begin(), middle + 1), threshold, lines);
      split(Points(middle, p.end()), threshold, lines);
      return;
    }
  }
  lines.push_back(fit(p));
}

std::vector<Line> iepf(const Scan& scan) {
  Points points;
  for (int i = 0; i < scan.beams(); ++i) {
    const double r = scan.ranges[as_index(i)];
    const double phi = scan.sensor.geometry.angle(i);
    if (std::isfinite(r)) points.emplace_back(r * std::cos(phi), r * std::sin(phi));
  }
  std::vector<Line> lines;
  split(points, 0.10, lines);
  return lines;
}

}  // namespace textbook

void run_textbook(benchmark::State& state) {
  const ScanSet& set = scans(static_cast<int>(state.range(0)));
  std::size_t lines = 0;
  for (auto _ : state) {
    lines = 0;
    for (std::size_t f = 0; f < set.frames.size(); ++f) lines += textbook::iepf(set.scan(f)).size();
    benchmark::DoNotOptimize(lines);
  }
  const double done = static_cast<double>(state.iterations()) * kPoses;
  state.counters["us_per_scan"] =
      benchmark::Counter(done * 1e-6, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["lines"] = static_cast<double>(lines) / kPoses;
}

/// Prints rows of bench/ratios.hpp: the fast extractors against the textbook's, and all others beside them.
void print_ratios(int rounds) {
  for (const int sigma_cm : {1, 5}) {
    const ScanSet& set = scans(sigma_cm);
    std::vector<bench::Method> methods{{"textbook IEPF", [&set] {
                                          for (std::size_t f = 0; f < set.frames.size(); ++f)
                                            benchmark::DoNotOptimize(textbook::iepf(set.scan(f)).size());
                                          return set.frames.size();
                                        }}};
    for (const char* name : {"iepf", "line_tracking", "sef", "optimal", "smf", "polyline"})
      methods.push_back({name,
                         [&set, module = std::shared_ptr(Registry<LineExtractor>::make(name))] {
                           Trace silent;
                           for (std::size_t f = 0; f < set.frames.size(); ++f)
                             benchmark::DoNotOptimize(module->extract(set.scan(f), silent).lines.data());
                           return set.frames.size();
                         },
                         sigma_cm == 1 && std::string(name) == "iepf" ? 20.0 : 0.0});
    bench::measure("lines of a scan of 451 beams, " + std::to_string(sigma_cm) + " cm noise", std::move(methods),
                   rounds);
  }
}

// Called from main(), because static initialisers of this file can run before those that fill the registry.
void register_all() {
  for (const int sigma_cm : {1, 5}) {
    benchmark::RegisterBenchmark("textbook_iepf", run_textbook)->ArgName("sigma_cm")->Arg(sigma_cm);
    for (const std::string& name : Registry<LineExtractor>::names())
      benchmark::RegisterBenchmark(name.c_str(), [name](benchmark::State& state) { run_module(state, name); })
          ->ArgName("sigma_cm")
          ->Arg(sigma_cm);
  }
}

}  // namespace
}  // namespace scanbench

int main(int argc, char** argv) {
  if (argc > 1 && std::string(argv[1]) == "--ratios") {
    scanbench::print_ratios(argc > 2 ? std::max(1, std::atoi(argv[2])) : 9);
    return 0;
  }
  scanbench::register_all();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
