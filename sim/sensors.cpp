// Defines sensors by the parameters of their data sheets. If a value is ours and not a document's, the preset's source
// says so.
#include "sim/sensors.hpp"

#include <cmath>
#include <cstdint>
#include <functional>
#include <tuple>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/geometry/angles.hpp"
#include "core/names.hpp"
#include "core/number_text.hpp"

namespace scanbench::sim {
namespace {

/// A sensor in the units of the scenario file.
struct SensorParams {
  double angle_min_deg = -90.0;
  double angle_step_deg = 0.5;
  std::int64_t beams = 361;
  double range_min_m = 0.0;
  double range_max_m = 30.0;
  double scan_period_s = 0.1;
  double time_per_beam_s = 0.0;
  double sigma_m = 0.0;
  double sigma_relative = 0.0;
  double relative_from_m = 0.0;
  double bearing_sigma_deg = 0.0;
  double quantum_m = 0.0;
  double dropout_probability = 0.0;
  double dropout_grazing = 0.0;
  double spurious_probability = 0.0;
  double beam_divergence_deg = 0.0;

  static auto fields() {
    using P = SensorParams;
    return std::tuple{
        field("angle_min_deg", &P::angle_min_deg, between(-360, 360), "deg", "direction of the first beam, 0 ahead"),
        field("angle_step_deg", &P::angle_step_deg, between(-360, 360), "deg",
              "from beam to beam, counter-clockwise positive"),
        field("beams", &P::beams, between(1, 1e6), "", "beams of a scan"),
        field("range_min_m", &P::range_min_m, at_least(0), "m", "closer surfaces give -inf (too close)"),
        field("range_max_m", &P::range_max_m, above(0), "m", "farther surfaces give +inf (nothing in range)"),
        field("scan_period_s", &P::scan_period_s, above(0), "s", "between the first beams of two scans"),
        field("time_per_beam_s", &P::time_per_beam_s, at_least(0), "s",
              "time from beam to beam; 0 fires all beams at once"),
        field("sigma_m", &P::sigma_m, at_least(0), "m", "standard deviation of the range, constant part"),
        field("sigma_relative", &P::sigma_relative, at_least(0), "",
              "standard deviation of the range, part proportional to it"),
        field("relative_from_m", &P::relative_from_m, at_least(0), "m",
              "0 adds both parts in quadrature; else the constant part acts below this range, the proportional part "
              "from it on"),
        field("bearing_sigma_deg", &P::bearing_sigma_deg, between(0, 45), "deg",
              "standard deviation of a beam's true direction about its nominal one"),
        field("quantum_m", &P::quantum_m, at_least(0), "m", "rounding step of ranges; 0 disables rounding"),
        field("dropout_probability", &P::dropout_probability, between(0, 1), "",
              "probability that a beam that hits returns nothing, at normal incidence"),
        field("dropout_grazing", &P::dropout_grazing, between(0, 1), "",
              "added to that probability at grazing incidence; in between it grows as (1 - cos(incidence))^2"),
        field("spurious_probability", &P::spurious_probability, between(0, 1), "",
              "probability of a short return, uniform between range_min_m and the true range"),
        field("beam_divergence_deg", &P::beam_divergence_deg, between(0, 45), "deg",
              "full opening angle of a beam; > 0 gives ranges between the two surfaces at depth edges (mixed pixels)")};
  }
};

SensorPreset preset(std::string name, std::string summary, std::string source, const SensorParams& params) {
  return {std::move(name), std::move(summary), std::move(source), to_param_set(params)};
}

std::map<std::string, SensorPreset, std::less<>> make_presets() {
  // Half of a turn of a 75 Hz mirror per 180 deg, 0.5 deg per beam.
  constexpr double kLmsBeam = 1.0 / 75.0 / 720.0;
  std::map<std::string, SensorPreset, std::less<>> all;
  const auto add = [&](SensorPreset p) { all.emplace(p.name, std::move(p)); };
  add(preset("custom", "half circle without noise; meant to be overridden", "no device", {}));
  add(preset("ladar_2d30", "IBEO Ladar 2D30: 270 deg, 0.6 deg, 451 beams, sigma 5 cm",
             "Borges & Aldon, ICPR 2000, section 4: field of view, step, sigma; range 30 m from the name, 10 Hz ours",
             {.angle_min_deg = -135.0,
              .angle_step_deg = 0.6,
              .beams = 451,
              .range_max_m = 30.0,
              .scan_period_s = 0.1,
              .time_per_beam_s = 0.1 / 600.0,
              .sigma_m = 0.05}));
  add(preset("urg_04lx", "Hokuyo URG-04LX: 239.77 deg, 360/1024 deg, 682 beams, 2 cm .. 4.095 m",
             "Hokuyo, URG series SCIP 2.0 specification (steps 44 to 725, front 384) and data sheet (10 mm to 1 m, 1 % "
             "beyond, 1 mm, 10 Hz); sigma is half of the printed accuracy, which is our reading",
             {.angle_min_deg = -119.53125,
              .angle_step_deg = 360.0 / 1024.0,
              .beams = 682,
              .range_min_m = 0.02,
              .range_max_m = 4.095,
              .scan_period_s = 0.1,
              .time_per_beam_s = 0.1 / 1024.0,
              .sigma_m = 0.005,
              .sigma_relative = 0.005,
              .relative_from_m = 1.0,
              .quantum_m = 0.001}));
  add(preset("sick_pls101", "SICK PLS 101: 180 deg, 0.5 deg, 361 beams, 5 cm steps, 7 cm .. 50 m",
             "Siadat et al., SICICA 1997, section 2: field of view, 5 cm, limits, 25 Hz mirror, 250 ms per scan; "
             "gaussian 2 cm before the rounding is ours",
             {.angle_min_deg = -90.0,
              .angle_step_deg = 0.5,
              .beams = 361,
              .range_min_m = 0.07,
              .range_max_m = 50.0,
              .scan_period_s = 0.25,
              .time_per_beam_s = 1.0 / 25.0 / 720.0,
              .sigma_m = 0.02,
              .quantum_m = 0.05}));
  const SensorParams lms{.angle_min_deg = -90.0,
                         .angle_step_deg = 0.5,
                         .beams = 361,
                         .range_max_m = 8.19,
                         .scan_period_s = 0.2,
                         .time_per_beam_s = kLmsBeam,
                         .sigma_m = 0.005,
                         .quantum_m = 0.001};
  const std::string lms_source =
      "SICK LMS200 data sheet (5 mm statistical error in millimetre mode) and Player driver documentation (8.19 m and "
      "81.9 m modes, 5 Hz over 38400 baud)";
  add(preset("sick_lms200", "SICK LMS200, millimetre mode: 180 deg, 0.5 deg, 361 beams, 8.19 m", lms_source, lms));
  SensorParams lms_cm = lms;
  lms_cm.range_max_m = 81.9;
  lms_cm.sigma_m = 0.01;
  lms_cm.quantum_m = 0.01;
  add(preset("sick_lms200_cm", "SICK LMS200, centimetre mode: 180 deg, 0.5 deg, 361 beams, 81.9 m",
             lms_source + "; sigma 1 cm is ours", lms_cm));
  add(preset(
      "dual_lms291", "two SICK LMS291 back to back as one 360 deg scan: 0.5 deg, 720 beams, 18 % drop-out",
      "the hallway log of Lakaemper, 2009, section V.A, has 722 values with two directions twice; sigma 8 mm and "
      "the drop-out are ours, after that log",
      {.angle_min_deg = -180.0,
       .angle_step_deg = 0.5,
       .beams = 720,
       .range_max_m = 80.0,
       .scan_period_s = 0.2,
       .time_per_beam_s = kLmsBeam,
       .sigma_m = 0.008,
       .dropout_probability = 0.18}));
  add(preset("fov110", "110 deg, 0.5 deg, 221 beams, sigma 1 cm",
             "Lakaemper, \"Augmenting Sparse Laser Scans with Virtual Scans\", 2010, section 6.2: 90 deg and 20 deg of "
             "overlap; the rest is ours",
             {.angle_min_deg = -55.0, .angle_step_deg = 0.5, .beams = 221, .range_max_m = 30.0, .sigma_m = 0.01}));
  add(preset("fov360", "360 deg, 0.5 deg, 720 beams, no limit of range, sigma 0.5, for worlds in units of their own",
             "ours, for the four-room arena of Lakaemper, \"Augmenting Sparse Laser Scans with Virtual Scans\", 2010, "
             "section 6.1 (arena width 400)",
             {.angle_min_deg = -180.0, .angle_step_deg = 0.5, .beams = 720, .range_max_m = 1e9, .sigma_m = 0.5}));
  return all;
}

void check_together(const SensorParams& p) {
  if (p.angle_step_deg == 0 && p.beams > 1)
    throw ParamError("angle_step_deg", "angle_step_deg is 0; beams must point to different directions");
  const double span = std::fabs(p.angle_step_deg) * static_cast<double>(p.beams - 1);
  if (!(span < 360.0))
    throw ParamError("beams", "beams and angle_step_deg span " + number_text(span) + " deg; allowed: less than 360");
  if (!(p.range_min_m < p.range_max_m))
    throw ParamError("range_min_m", "range_min_m is " + number_text(p.range_min_m) +
                                        "; allowed: less than range_max_m, " + number_text(p.range_max_m));
  if (p.relative_from_m > 0 && p.relative_from_m < p.range_max_m && p.sigma_m > 0 && p.sigma_relative == 0)
    throw ParamError("sigma_relative",
                     "sigma_relative is 0, so that readings from relative_from_m, " + number_text(p.relative_from_m) +
                         " m, on have no noise; allowed: relative_from_m: 0, the constant part at all "
                         "ranges, or sigma_relative > 0");
  const double sweep = p.time_per_beam_s * static_cast<double>(p.beams - 1);
  if (!(sweep <= p.scan_period_s))
    throw ParamError("time_per_beam_s", "time_per_beam_s makes a sweep of " + number_text(sweep) +
                                            " s; allowed: at most scan_period_s, " + number_text(p.scan_period_s));
}

}  // namespace

const std::map<std::string, SensorPreset, std::less<>>& sensor_presets() {
  static const std::map<std::string, SensorPreset, std::less<>> presets = make_presets();
  return presets;
}

std::vector<ParamSpec> sensor_param_specs() {
  return param_specs<SensorParams>();
}

SensorModel make_sensor(const std::string& preset_name, const ParamSet& overrides, ParamSet* effective) {
  const auto& presets = sensor_presets();
  const auto found = presets.find(preset_name);
  if (found == presets.end()) {
    std::vector<std::string> names;
    std::string known;
    for (const auto& [name, unused] : presets) {
      names.push_back(name);
      known += (known.empty() ? "" : ", ") + name;
    }
    const std::string near = nearest_name(preset_name, names);
    throw ConfigError("unknown sensor preset '" + preset_name + "'" +
                      (near.empty() ? "; " : "; did you mean '" + near + "'? ") + "known: " + known);
  }
  ParamSet set = found->second.params;
  for (const auto& [name, value] : overrides) set.insert_or_assign(name, value);
  const auto p = make_params<SensorParams>(set);
  check_together(p);
  if (effective != nullptr) *effective = to_param_set(p);

  SensorModel sensor;
  sensor.name = found->second.name;
  sensor.source = found->second.source;
  sensor.geometry = ScanGeometry(radians(p.angle_min_deg), radians(p.angle_step_deg), static_cast<int>(p.beams));
  sensor.range_min_m = p.range_min_m;
  sensor.range_max_m = p.range_max_m;
  sensor.time_per_beam_s = p.time_per_beam_s;
  sensor.scan_period_s = p.scan_period_s;
  sensor.noise = {.sigma_m = p.sigma_m,
                  .sigma_relative = p.sigma_relative,
                  .relative_from_m = p.relative_from_m,
                  .bearing_sigma_rad = radians(p.bearing_sigma_deg),
                  .quantum_m = p.quantum_m,
                  .dropout_probability = p.dropout_probability,
                  .dropout_grazing = p.dropout_grazing,
                  .spurious_probability = p.spurious_probability,
                  .beam_divergence_rad = radians(p.beam_divergence_deg)};
  return sensor;
}

}  // namespace scanbench::sim
