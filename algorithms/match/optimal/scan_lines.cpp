// Covariances of lines, the extractor's or those of a fit to their support.
#include "algorithms/match/optimal/scan_lines.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

#include <Eigen/LU>

#include "algorithms/extract/parts/beam_line.hpp"
#include "algorithms/match/parts/scan_points.hpp"

namespace scanbench::matching {
namespace {

bool usable(const Eigen::Matrix2d& covariance) {
  return covariance.allFinite() && covariance(0, 0) > 0 && covariance.determinant() > 0;
}

/// Readings that support each line.
std::vector<std::vector<extract::BeamReading>> support(const Observation& observation) {
  std::vector<std::vector<extract::BeamReading>> readings(observation.lines.lines.size());
  const Scan& scan = observation.scan;
  for (int i = 0; i < scan.beams() && static_cast<std::size_t>(i) < observation.lines.labels.size(); ++i) {
    const int label = observation.lines.labels[static_cast<std::size_t>(i)];
    if (label < 0 || !scan.valid(i)) continue;
    readings[static_cast<std::size_t>(label)].push_back(
        {scan.sensor.geometry.direction(i), scan.ranges[static_cast<std::size_t>(i)]});
  }
  return readings;
}

/// Sets the plain line; without a fit it remains the line itself.
void set_plain(MeasuredLine& line, const std::optional<extract::BeamLine>& fit) {
  line.plain_covariance = line.covariance;
  if (!fit) return;
  const Eigen::Matrix2d covariance = extract::line_covariance(*fit, line.middle);
  const double cosine = fit->normal().dot(line.normal);
  if (!usable(covariance) || !(cosine > 0)) return;
  line.plain_covariance = covariance;
  line.plain_place << (fit->rho() - fit->normal().dot(line.middle)) / cosine,
      std::atan2(cross(line.normal, fit->normal()), cosine);
}

std::vector<MeasuredLine> extracted_lines(const Observation& observation) {
  std::vector<MeasuredLine> result;
  const std::vector<std::vector<extract::BeamReading>> readings = support(observation);
  for (std::size_t k = 0; k < observation.lines.lines.size(); ++k) {
    const LineFeature& line = observation.lines.lines[k];
    MeasuredLine measured{line.segment.midpoint(), line.line.normal(), 0.5 * line.segment.length()};
    if (!measured.middle.allFinite() || !(measured.half_length > 0)) continue;
    const auto fit = extract::fit_beam_line(readings[k], observation.scan.sensor.noise);
    if (line.covariance) {
      measured.covariance = *line.covariance;
    } else {
      if (!fit) continue;
      measured.normal = fit->normal();
      measured.middle -= (measured.normal.dot(measured.middle) - fit->rho()) * measured.normal;
      measured.covariance = extract::line_covariance(*fit, measured.middle);
    }
    if (!usable(measured.covariance)) continue;
    set_plain(measured, fit);
    result.push_back(measured);
  }
  return result;
}

constexpr std::size_t kFewestReadings = 3;
constexpr std::size_t kLongestRun = 48;     // of returns looked at together; what is longer is cut
constexpr double kLargestAngleSigma = 0.3;  // rad; beyond, a line is not a wall with a direction

/// A line with the sum of squared residuals in standard deviations.
struct Explained {
  extract::BeamLine line;
  double misfit = 0.0;
};

class Unexplained {
 public:
  Unexplained(const SensorNoise& noise, ScanMeasurements& found) : noise_(noise), found_(found) {}

  void add_run(std::span<const extract::BeamReading> run) {
    for (std::size_t begin = 0; begin < run.size(); begin += kLongestRun)
      explain(run.subspan(begin, std::min(kLongestRun, run.size() - begin)));
  }

 private:
  std::optional<Explained> fit(std::span<const extract::BeamReading> readings) const {
    const auto line = extract::fit_beam_line(readings, noise_);
    if (!line) return std::nullopt;
    Explained result{*line, 0.0};
    for (const extract::BeamReading& reading : readings) {
      const double range = line->range(reading.direction);
      const double error = (reading.range_m - range) / extract::reading_sigma(noise_, range, 0.0);
      result.misfit += error * error;
    }
    return result;
  }

  /// Chi-square with n - 2 degrees of freedom, three standard deviations above its mean at most.
  static bool allowed(double misfit, std::size_t n) {
    const auto freedom = static_cast<double>(n - 2);
    return misfit <= freedom + 3.0 * std::sqrt(2.0 * freedom);
  }

  void explain(std::span<const extract::BeamReading> run) {
    if (run.size() < kFewestReadings) {
      leave(run);
      return;
    }
    const auto whole = fit(run);
    if (whole && allowed(whole->misfit, run.size())) {
      keep(run, whole->line);
      return;
    }
    std::size_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t cut = 1; cut < run.size(); ++cut) {
      const double misfit = cost(run.first(cut)) + cost(run.subspan(cut));
      if (misfit >= least) continue;
      least = misfit;
      best = cut;
    }
    if (best == 0) {
      leave(run);
      return;
    }
    explain(run.first(best));
    explain(run.subspan(best));
  }

  double cost(std::span<const extract::BeamReading> run) const {
    if (run.size() <= 2) return 0.0;
    const auto explained = fit(run);
    return explained ? explained->misfit : 1e12;
  }

  void keep(std::span<const extract::BeamReading> run, const extract::BeamLine& line) {
    const Vec2 first = line.range(run.front().direction) * run.front().direction;
    const Vec2 last = line.range(run.back().direction) * run.back().direction;
    const Vec2 middle = 0.5 * (first + last);
    const MeasuredLine measured{middle, line.normal(), 0.5 * (last - first).norm(),
                                extract::line_covariance(line, middle)};
    if (usable(measured.covariance) && measured.covariance(1, 1) <= kLargestAngleSigma * kLargestAngleSigma &&
        measured.half_length > 0)
      found_.lines.push_back(measured);
    else
      leave(run);
  }

  void leave(std::span<const extract::BeamReading> run) {
    for (const extract::BeamReading& reading : run)
      found_.returns.push_back(
          {reading.range_m * reading.direction, extract::reading_sigma(noise_, reading.range_m, 0.0)});
  }

  const SensorNoise& noise_;
  ScanMeasurements& found_;
};

}  // namespace

ScanMeasurements measurements(const Observation& observation) {
  ScanMeasurements result{extracted_lines(observation), {}};
  const Scan& scan = observation.scan;
  Unexplained unexplained(scan.sensor.noise, result);
  std::vector<extract::BeamReading> run;
  for (int i = 0; i < scan.beams(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    if (!scan.valid(i)) continue;
    const bool explained = at < observation.lines.labels.size() && observation.lines.labels[at] >= 0;
    if (!explained && scan.ranges[at] < kFarthestM) {
      run.push_back({scan.sensor.geometry.direction(i), scan.ranges[at]});
    } else {
      unexplained.add_run(run);
      run.clear();
    }
  }
  unexplained.add_run(run);
  return result;
}

MeasuredLine moved(const Pose2& b_from_a, const MeasuredLine& line) {
  MeasuredLine result = line;
  result.middle = b_from_a * line.middle;
  result.normal = b_from_a.rotate(line.normal);
  return result;
}

}  // namespace scanbench::matching
