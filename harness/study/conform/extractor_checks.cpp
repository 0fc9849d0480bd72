// Checks of line extractors, on scans that break careless implementations.
#include "harness/study/conform/extractor_checks.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <Eigen/LU>

#include "core/index.hpp"
#include "core/number_text.hpp"
#include "core/rng.hpp"
#include "core/special_values.hpp"
#include "harness/study/conform/scenes.hpp"

namespace scanbench::study::conform {
namespace {

using Extractors = Subject<LineExtractor>;

/// Everything that core/scan.hpp promises about labels.
void check_labels(const Scan& scan, const ScanLines& result, Findings& findings) {
  const int lines = static_cast<int>(result.lines.size());
  findings.expect(result.labels.size() == scan.ranges.size(),
                  std::to_string(result.labels.size()) + " labels for " + std::to_string(scan.beams()) + " beams");
  if (result.labels.size() != scan.ranges.size()) return;
  std::vector<int> count(result.lines.size(), 0), first(result.lines.size(), -1), last(result.lines.size(), -1);
  for (int beam = 0; beam < scan.beams(); ++beam) {
    const int label = result.labels[as_index(beam)];
    const std::string place = "beam " + std::to_string(beam);
    findings.expect(label >= -1 && label < lines, place + " has the label " + std::to_string(label));
    if (label < 0 || label >= lines) continue;
    findings.expect(scan.valid(beam), place + " has no return but supports line " + std::to_string(label));
    const std::size_t k = as_index(label);
    if (count[k]++ == 0) first[k] = beam;
    last[k] = beam;
  }
  for (std::size_t k = 0; k < result.lines.size(); ++k) {
    const LineFeature& f = result.lines[k];
    const std::string line = "line " + std::to_string(k);
    findings.expect(f.points >= 1 && f.points == count[k],
                    line + " has points " + std::to_string(f.points) + ", and " + std::to_string(count[k]) + " labels");
    findings.expect(f.first_beam == first[k] && f.last_beam == last[k],
                    line + " has other first and last beams than its labels");
    findings.expect(k == 0 || f.first_beam > result.lines[k - 1].first_beam, line + " is not in scan order");
  }
}

/// Everything that core/scan.hpp promises about lines.
void check_geometry(const ScanLines& result, Findings& findings) {
  for (std::size_t k = 0; k < result.lines.size(); ++k) {
    const LineFeature& f = result.lines[k];
    const std::string line = "line " + std::to_string(k);
    findings.expect(f.segment.a.allFinite() && f.segment.b.allFinite(), line + " has an end that is not finite");
    findings.expect(f.line.rho >= 0.0 && std::isfinite(f.line.rho), line + " has a rho that is negative or not finite");
    findings.expect(f.line.alpha > -kPi && f.line.alpha <= kPi, line + " has an alpha outside of (-pi, pi]");
    findings.expect(f.rms_m >= 0.0 && std::isfinite(f.rms_m), line + " has an rms that is negative or not finite");
    for (const Vec2& end : {f.segment.a, f.segment.b})
      findings.expect(std::fabs(f.line.signed_distance(end)) <= 1e-6 * (1.0 + end.norm()),
                      line + " has an end that is not on it");
    if (!f.covariance) continue;
    const Eigen::Matrix2d& c = *f.covariance;
    findings.expect(c.allFinite() && c(0, 0) >= 0.0 && c(1, 1) >= 0.0 && c.determinant() >= -1e-9 * c(0, 0) * c(1, 1) &&
                        std::fabs(c(0, 1) - c(1, 0)) <= 1e-12 + 1e-9 * c.norm(),
                    line + " has a covariance that is none");
  }
}

/// An instance with its checks.
class CheckedExtractor {
 public:
  CheckedExtractor(const Extractors& subject, Findings& findings, const ParamSet& params = {})
      : module_(subject.make(params)), findings_(findings) {}

  ScanLines operator()(const OwnedScan& scan) const {
    Trace silent;
    const Scan view = scan.view();
    ScanLines result = module_->extract(view, silent);
    check_labels(view, result, findings_);
    check_geometry(result, findings_);
    return result;
  }

 private:
  std::unique_ptr<LineExtractor> module_;
  Findings& findings_;
};

OwnedScan noisy_room(std::uint64_t seed, int beams = 361) {
  return with_noise(cast(ring_sensor(beams), random_room(seed)), 0.01, seed);
}

bool is_near_line(const PolarLine& found, const PolarLine& expected, double tolerance) {
  const LineDifference d = line_difference(found, expected);
  return d.rho <= tolerance && d.alpha <= tolerance;
}

bool identical(const ScanLines& a, const ScanLines& b) {
  const auto same = [](const LineFeature& x, const LineFeature& y) {
    return x.segment == y.segment && x.line == y.line && x.covariance == y.covariance && x.first_beam == y.first_beam &&
           x.last_beam == y.last_beam && x.points == y.points && x.rms_m == y.rms_m;
  };
  return a.labels == b.labels && std::ranges::equal(a.lines, b.lines, same);
}

void no_beams(const Extractors& subject, Findings& findings) {
  findings.expect(CheckedExtractor(subject, findings)(constant_scan(fan_sensor(0, 1.0), 1.0)).lines.empty(),
                  "a scan without beams has lines");
}

void no_returns(const Extractors& subject, Findings& findings) {
  const CheckedExtractor extract(subject, findings);
  for (const double nothing : {kInf, -kInf, kNaN, 0.0, -1.0})
    findings.expect(extract(constant_scan(fan_sensor(181, kPi), nothing)).lines.empty(),
                    "a scan of readings " + number_text(nothing) + " has lines");
}

void few_returns(const Extractors& subject, Findings& findings) {
  const CheckedExtractor extract(subject, findings);
  for (int returns = 1; returns <= 3; ++returns) {
    OwnedScan scan = constant_scan(fan_sensor(181, kPi), kInf);
    for (int i = 0; i < returns; ++i) scan.ranges[as_index(60 + 3 * i)] = 2.0 + 0.1 * i;
    findings.expect(extract(scan).lines.size() <= as_index(returns), "there are more lines than returns");
  }
  findings.expect(extract(constant_scan(fan_sensor(1, 1.0), 2.0)).lines.size() <= 1, "one beam has several lines");
}

void odd_points(const Extractors& subject, Findings& findings) {
  const CheckedExtractor extract(subject, findings);
  extract(constant_scan(fan_sensor(50, 0.0), 2.0));  // all beams in one direction
  extract(constant_scan(ring_sensor(360), 1e-12));   // all points practically at the sensor
  extract(constant_scan(ring_sensor(360), 2.0));     // a circle
  OwnedScan ray = constant_scan(fan_sensor(50, 0.0), 1.0);
  for (std::size_t i = 0; i < 50; ++i) ray.ranges[i] += 0.05 * static_cast<double>(i);
  extract(ray);                                                 // all points on one ray
  extract(cast(ring_sensor(360), {{{-5, 1e-7}, {5, -1e-7}}}));  // a wall seen edge-on
}

void wall(const Extractors& subject, Findings& findings) {
  const ScanLines result = CheckedExtractor(subject, findings)(cast(fan_sensor(91, radians(90)), {{{2, -9}, {2, 9}}}));
  findings.expect(!result.lines.empty(), "a wall without noise has no line");
  for (const auto& line : result.lines)
    findings.expect(is_near_line(line.line, {2.0, 0.0}, 1e-3), "the line of a wall at 2 m is elsewhere");
}

void wall_once(const Extractors& subject, Findings& findings) {
  const ScanLines result = CheckedExtractor(subject, findings)(cast(fan_sensor(91, radians(90)), {{{2, -9}, {2, 9}}}));
  findings.expect(result.lines.size() == 1,
                  "a wall without noise has " + std::to_string(result.lines.size()) + " lines");
  if (result.lines.size() != 1) return;
  const LineFeature& line = result.lines.front();
  findings.expect(line.points == 91, "of its 91 returns " + std::to_string(line.points) + " support the line");
  findings.expect((line.segment.a - Vec2(2, -2)).norm() < 2e-3 && (line.segment.b - Vec2(2, 2)).norm() < 2e-3,
                  "the line does not end where the wall leaves the field of view");
}

void clockwise(const Extractors& subject, Findings& findings) {
  SensorModel sensor;
  sensor.geometry = ScanGeometry(radians(45), -radians(1), 91);
  const ScanLines result = CheckedExtractor(subject, findings)(cast(sensor, {{{2, -9}, {2, 9}}}));
  findings.expect(!result.lines.empty(), "a clockwise scan of a wall has no line");
  for (const auto& line : result.lines) {
    findings.expect(is_near_line(line.line, {2.0, 0.0}, 1e-3), "the line of a wall at 2 m is elsewhere");
    findings.expect(line.segment.a.y() < line.segment.b.y(), "the sensor is not on the left of a -> b");
  }
}

void corner(const Extractors& subject, Findings& findings) {
  const OwnedScan scan = cast(fan_sensor(91, radians(90)), {{{2, -3}, {2, 0.5}}, {{2, 0.5}, {-3, 0.5}}});
  findings.expect(!CheckedExtractor(subject, findings)(scan).lines.empty(), "a corner has no line");
}

void seam(const Extractors& subject, Findings& findings) {
  const ScanLines result = CheckedExtractor(subject, findings)(cast(ring_sensor(360), {{{-2, -2}, {-2, 2}}}));
  findings.expect(!result.lines.empty(), "a wall behind the sensor has no line");
  for (const auto& line : result.lines)
    findings.expect(is_near_line(line.line, {2.0, kPi}, 1e-3), "the line of a wall at 2 m is elsewhere");
  findings.expect(result.labels.size() == 360 && result.labels.front() >= 0 && result.labels.back() >= 0,
                  "the wall is not found on both sides of the seam");
}

void beams(const Extractors& subject, Findings& findings) {
  const CheckedExtractor extract(subject, findings);
  extract(cast(ring_sensor(10), box(-2, -2, 2, 2)));
  findings.expect(!extract(noisy_room(3, 100000)).lines.empty(), "a room seen with 100 000 beams has no line");
}

void holes(const Extractors& subject, Findings& findings) {
  const CheckedExtractor extract(subject, findings);
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    OwnedScan scan = noisy_room(seed);
    CounterRng rng(seed, RngStream::dropout);
    for (double& r : scan.ranges) {
      const double u = rng.uniform();
      if (u < 0.05) r = kInf;
      if (u > 0.95) r = kNaN;
      if (u > 0.45 && u < 0.5) r *= rng.uniform();  // spurious short returns
    }
    findings.expect(!extract(scan).lines.empty(), "a room with holes has no line");
  }
}

void scales(const Extractors& subject, Findings& findings) {
  const CheckedExtractor extract(subject, findings);
  for (const double scale : {1e-6, 1e-3, 1e3, 1e6}) {
    OwnedScan scan = noisy_room(5);
    for (double& r : scan.ranges) r *= scale;
    extract(scan);
  }
}

void rotation(const Extractors& subject, Findings& findings) {
  const CheckedExtractor extract(subject, findings);
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const double angle = 0.3 + 1.1 * static_cast<double>(seed);
    const OwnedScan scan = noisy_room(seed);
    const ScanLines before = extract(scan), after = extract(turned(scan, angle));
    const Pose2 turn(0, 0, angle);
    bool same = before.labels == after.labels && before.lines.size() == after.lines.size();
    for (std::size_t k = 0; same && k < before.lines.size(); ++k) {
      const Segment expected = turn * before.lines[k].segment;
      const Segment& found = after.lines[k].segment;
      same = is_near_line(after.lines[k].line, transform(turn, before.lines[k].line), 1e-6) &&
             (found.a - expected.a).norm() < 1e-6 && (found.b - expected.b).norm() < 1e-6 &&
             std::fabs(after.lines[k].rms_m - before.lines[k].rms_m) < 1e-6;
    }
    findings.expect(same, "a scene turned by " + number_text(angle) + " rad about the sensor has other lines");
  }
}

void extract_again(const Extractors& subject, Findings& findings) {
  const CheckedExtractor extract(subject, findings);
  const OwnedScan scan = noisy_room(6);
  const std::vector<double> copy = scan.ranges;
  const ScanLines first = extract(scan);
  findings.expect(scan.ranges == copy, "the scan was changed");
  findings.expect(identical(first, extract(scan)), "the same scan has other lines the second time");
  extract(noisy_room(7));
  findings.expect(identical(first, extract(scan)), "the same scan has other lines after another scan");
  findings.expect(identical(first, CheckedExtractor(subject, findings)(scan)), "a second instance finds other lines");
  const Trace listening({.stage = [](Stage) {}, .row = [](const TraceSchema&, std::span<const double>) {}});
  Trace trace = listening;
  findings.expect(identical(first, subject.make({})->extract(scan.view(), trace)),
                  "a trace that listens changes the lines");
}

/// Both values of a switch, every choice, and every closed bound of a parameter.
std::vector<ParamValue> extremes(const ParamSpec& spec) {
  std::vector<ParamValue> values;
  if (spec.type == ParamType::boolean) values = {true, false};
  for (const auto& choice : spec.choices) values.emplace_back(choice);
  for (const double bound : {spec.bounds.min, spec.bounds.max}) {
    if (!std::isfinite(bound) || (bound == spec.bounds.min && spec.bounds.open_min)) continue;
    if (spec.type == ParamType::number) values.emplace_back(bound);
    if (spec.type == ParamType::integer) values.emplace_back(static_cast<std::int64_t>(bound));
  }
  return values;
}

void parameter_ends(const Extractors& subject, Findings& findings) {
  const OwnedScan room = noisy_room(9, 120), nothing = constant_scan(ring_sensor(120), kInf);
  for (const ParamSpec& spec : subject.params)
    for (const ParamValue& value : extremes(spec)) {
      Findings here;
      const CheckedExtractor extract(subject, here, {{spec.name, value}});
      extract(room);
      extract(nothing);
      for (const auto& fault : here.faults())
        findings.expect(false, "with " + spec.name + " = " + to_text(value) + ": " + fault);
    }
}

}  // namespace

const std::vector<Check<LineExtractor>>& extractor_checks() {
  static const std::vector<Check<LineExtractor>> checks{
      {"AScanWithoutBeamsHasNoLines", no_beams},
      {"AScanWithoutReturnsHasNoLines", no_returns},
      {"OneTwoAndThreeReturnsAreAnswered", few_returns},
      {"EqualPointsCirclesAndWallsSeenEdgeOnAreAnswered", odd_points},
      {"ANoiseFreeWallHasItsLineInItsPlace", wall},
      {"ANoiseFreeWallIsOneLine", wall_once},
      {"AClockwiseScannerGivesTheSameWallWithTheSensorOnItsLeft", clockwise},
      {"ACornerIsAnswered", corner},
      {"AWallAcrossTheSeamOfAFullTurnIsFoundOnBothSides", seam},
      {"TenAndAHundredThousandBeamsAreAnswered", beams},
      {"RoomsWithHolesAreAnswered", holes},
      {"HugeAndTinyScenesAreAnswered", scales},
      {"TheLinesTurnWithTheSceneAboutTheSensor", rotation},
      {"TheAnswerIsTheSameTwiceAndTheScanUntouched", extract_again},
      {"EveryParameterAtItsEndsGivesAConsistentAnswer", parameter_ends},
  };
  return checks;
}

}  // namespace scanbench::study::conform
