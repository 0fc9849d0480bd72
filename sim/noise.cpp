// Computes noisy readings, for one beam or for a whole scan.
#include "sim/noise.hpp"

#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <vector>

#include "core/geometry/geometry.hpp"
#include "core/geometry/portable_math.hpp"
#include "core/isa.hpp"
#include "core/rng.hpp"
#include "sim/lanes/draw_kernels.hpp"
#include "sim/lanes/reading_kernels.hpp"

namespace scanbench::sim {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

CounterRng draws(const BeamAddress& address, RngStream stream) {
  return {address.seed, stream, address.frame, address.beam};
}

// The random numbers of one reading, drawn one by one.
struct BeamDraws {
  const SensorNoise& noise;
  const BeamAddress& address;
  double sigma(double range_m) const { return noise.gaussian_sigma(range_m); }
  double dropout() const { return draws(address, RngStream::dropout).uniform(); }
  double normal() const { return draws(address, RngStream::range).normal(); }
};

// `random` has the numbers of this reading, dropout() and normal(), and sigma(range) of the gaussian error.
template <class Random>
double reading(const SensorModel& sensor, double true_range_m, double cos_incidence, const BeamAddress& address,
               const Random& random, double loss) {
  const SensorNoise& noise = sensor.noise;
  double range = true_range_m;
  if (!(range <= sensor.range_max_m)) return kInf;
  if (range < sensor.range_min_m) return -kInf;
  if (noise.dropout_probability > 0 || noise.dropout_grazing > 0 || loss > 0) {
    const double slant = 1.0 - cos_incidence;
    const double probability = noise.dropout_probability + noise.dropout_grazing * slant * slant + loss;
    if (random.dropout() < probability) return kInf;
  }
  if (noise.spurious_probability > 0) {
    CounterRng spurious = draws(address, RngStream::spurious);
    if (spurious.uniform() < noise.spurious_probability)
      range = sensor.range_min_m + spurious.uniform() * (range - sensor.range_min_m);
  }
  const double sigma = random.sigma(range);
  if (sigma > 0) range += sigma * random.normal();
  if (noise.quantum_m > 0) range = std::floor(range / noise.quantum_m + 0.5) * noise.quantum_m;
  if (range < sensor.range_min_m || range <= 0) return -kInf;
  return range <= sensor.range_max_m ? range : kInf;
}

// Pads a list of beams to a multiple of 8.
void fill_up(std::vector<std::uint32_t>& beams) {
  while (beams.size() % 8 != 0) beams.push_back(beams.back());
}

const DrawKernels& draw_kernels_for(Isa isa) {
  return build_for(isa, baseline::kDrawKernels, v3::kDrawKernels);
}

const ReadingKernels& reading_kernels_for(Isa isa) {
  return build_for(isa, baseline::kReadingKernels, v3::kReadingKernels);
}

// One number for each of `beams`, whose size is a multiple of 8.
template <class Kernel>
void draw(Kernel kernel, std::uint64_t seed, RngStream stream, std::uint32_t frame,
          const std::vector<std::uint32_t>& beams, std::vector<double>& numbers) {
  numbers.resize(beams.size());
  kernel({.seed = seed, .stream = static_cast<std::uint32_t>(stream), .frame = frame, .beams = beams.data()},
         static_cast<int>(beams.size()), numbers.data());
}

}  // namespace

Vec2 rotated(const Vec2& v, double angle_rad) {
  const auto [s, c] = portable::sincos(angle_rad);
  return {c * v.x() - s * v.y(), s * v.x() + c * v.y()};
}

double bearing_error(const SensorNoise& noise, const BeamAddress& address) {
  if (!(noise.bearing_sigma_rad > 0)) return 0.0;
  return noise.bearing_sigma_rad * draws(address, RngStream::bearing).normal();
}

double mixed_range(double range_a_m, double range_b_m, const BeamAddress& address) {
  return range_a_m + draws(address, RngStream::mixed_pixel).uniform() * (range_b_m - range_a_m);
}

double observed_range(const SensorModel& sensor, double true_range_m, double cos_incidence, const BeamAddress& address,
                      double loss) {
  return reading(sensor, true_range_m, cos_incidence, address, BeamDraws{sensor.noise, address}, loss);
}

ScanNoise::ScanNoise(const SensorModel& sensor, std::uint64_t seed, Isa isa)
    : sensor_(sensor), seed_(seed), kernels_(draw_kernels_for(isa)), reading_kernels_(reading_kernels_for(isa)) {}

bool ScanNoise::needs_incidence(const SensorNoise& noise) {
  return noise.dropout_probability > 0 || noise.dropout_grazing > 0;
}

std::span<const double> ScanNoise::bearing_errors(std::uint32_t frame, std::size_t beams) {
  const double sigma = sensor_.noise.bearing_sigma_rad;
  if (!(sigma > 0) || beams == 0) return {};
  beams_.resize(beams);
  std::iota(beams_.begin(), beams_.end(), 0U);
  fill_up(beams_);
  draw(kernels_.normals, seed_, RngStream::bearing, frame, beams_, bearings_);
  for (double& angle : bearings_) angle = sigma * angle;
  return std::span(bearings_).first(beams);
}

// Beams that return nothing need no random numbers: `beams_` becomes the list of the others.
std::size_t ScanNoise::list_returns(std::span<const double> true_ranges) {
  beams_.resize(true_ranges.size() + 8);
  const int count = reading_kernels_.list_returns(true_ranges.data(), static_cast<int>(true_ranges.size()),
                                                  sensor_.range_min_m, sensor_.range_max_m, beams_.data());
  beams_.resize(static_cast<std::size_t>(count));
  if (count > 0) fill_up(beams_);
  return static_cast<std::size_t>(count);
}

bool ScanNoise::is_gaussian_alone(std::span<const double> losses) const {
  const SensorNoise& noise = sensor_.noise;
  return noise.sigma_m > 0 && noise.sigma_relative == 0 && noise.relative_from_m == 0 && noise.quantum_m == 0 &&
         noise.spurious_probability == 0 && !needs_incidence(noise) && losses.empty();
}

void ScanNoise::draw_normals(std::uint32_t frame) {
  draw(kernels_.normals, seed_, RngStream::range, frame, beams_, normals_);
}

void ScanNoise::observe_gaussian(std::uint32_t frame, std::span<const double> true_ranges, std::span<double> readings) {
  list_returns(true_ranges);
  draw_normals(frame);
  normals_.resize(beams_.size() + 8);  // the kernel reads whole groups
  reading_kernels_.observe(true_ranges.data(), static_cast<int>(true_ranges.size()),
                           {.range_min_m = sensor_.range_min_m,
                            .range_max_m = sensor_.range_max_m,
                            .sigma_m = sensor_.noise.gaussian_sigma(0.0)},
                           normals_.data(), readings.data());
}

void ScanNoise::observe(std::uint32_t frame, std::span<const double> true_ranges, std::span<const double> cos_incidence,
                        std::span<double> readings, std::span<const double> losses) {
  if (is_gaussian_alone(losses)) {
    observe_gaussian(frame, true_ranges, readings);
    return;
  }
  const SensorNoise& noise = sensor_.noise;
  for (std::size_t i = 0; i < true_ranges.size(); ++i)
    readings[i] = true_ranges[i] < sensor_.range_min_m ? -kInf : kInf;
  const std::size_t count = list_returns(true_ranges);
  if (noise.sigma_m > 0 || noise.sigma_relative > 0) draw_normals(frame);
  if (needs_incidence(noise) || !losses.empty())
    draw(kernels_.uniforms, seed_, RngStream::dropout, frame, beams_, dropouts_);
  struct ScanDraws {
    const ScanNoise& scan;
    std::size_t place;
    bool constant;  ///< without a proportional part sigma is the same for all ranges
    double constant_sigma;
    double sigma(double range_m) const {
      return constant ? constant_sigma : scan.sensor_.noise.gaussian_sigma(range_m);
    }
    double dropout() const { return scan.dropouts_[place]; }
    double normal() const { return scan.normals_[place]; }
  };
  const bool constant = noise.sigma_relative == 0 && noise.relative_from_m == 0;
  const double sigma = noise.gaussian_sigma(0.0);
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t i = beams_[k];
    readings[i] =
        reading(sensor_, true_ranges[i], cos_incidence.empty() ? 0.0 : cos_incidence[i], {seed_, frame, beams_[k]},
                ScanDraws{*this, k, constant, sigma}, losses.empty() ? 0.0 : losses[i]);
  }
}

}  // namespace scanbench::sim
