// Gates from the error of the given poses; status and message of a joint solution.
#include "algorithms/align/parts/outcome.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>

#include "core/number_text.hpp"

namespace scanbench::align {
namespace {

constexpr double kGateSigmas = 2.5;

void add_sentence(const std::string& sentence, std::string& text) {
  if (!sentence.empty()) text += (text.empty() ? "" : "; ") + sentence;
}

}  // namespace

double gate_for(const OdometryError& error, std::span<const double> levers_m) {
  std::vector<double> levers(levers_m.begin(), levers_m.end());
  double lever = 0.0;
  if (!levers.empty()) {
    const auto middle = levers.begin() + static_cast<std::ptrdiff_t>(levers.size() / 2);
    std::nth_element(levers.begin(), middle, levers.end());
    lever = *middle;
  }
  return kGateSigmas * std::numbers::sqrt2 * std::hypot(error.sigma_m, error.sigma_rad * lever);
}

std::string movement_text(double value) {
  if (!(value > 0) || !std::isfinite(value)) return number_text(value);
  const double digit = std::pow(10.0, std::floor(std::log10(value)));
  const double rounded = digit < 1.0 ? std::round(value / digit) / std::round(1.0 / digit)  // 7 / 10000 is 0.0007
                                     : std::round(value / digit) * digit;
  std::array<char, 700> buffer{};  // of a double in fixed notation
  const auto [end, error] =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), rounded, std::chars_format::fixed);
  return {buffer.data(), end};
}

Alignment judged(const Outcome& outcome, std::span<const Pose2> initial, std::span<const Pose2> poses) {
  Alignment result;
  result.world_from_sensor.assign(initial.begin(), initial.end());
  if (outcome.groups.groups().size() == initial.size()) {
    result.status = Status::no_match;
    result.message = "no two scans meet";
    return result;
  }
  if (!outcome.converged) {
    result.status = Status::max_iterations;
    add_sentence("poses still moved by " + movement_text(outcome.last.shift_m) + " m and " +
                     movement_text(degrees(outcome.last.turn_rad)) + " deg in round " + std::to_string(outcome.rounds),
                 result.message);
  }
  if (outcome.slides || !outcome.groups.together()) result.status = Status::degenerate;
  if (outcome.slides) add_sentence("some scans can slide along what they meet", result.message);
  add_sentence(outcome.groups.complaint(), result.message);
  result.world_from_sensor = held_at_first(initial, poses);
  return result;
}

}  // namespace scanbench::align
