// Chooses between metres and millimetres, and between seconds, milliseconds and microseconds.
#include "render/layout/shown_unit.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace scanbench::render {
namespace {

constexpr double kLeastMetres = 0.1;

/// `seconds`: how many of them are a unit of the data.
ShownUnit time_unit(double largest, double seconds) {
  if (largest * seconds >= 1.0) return {"s", seconds};
  if (largest * seconds >= 1e-3) return {"ms", 1e3 * seconds};
  return {"µs", 1e6 * seconds};
}

}  // namespace

ShownUnit shown_unit(const std::string& unit, double low, double high, bool log) {
  const double typical = log ? std::sqrt(low * high) : std::max(std::abs(low), std::abs(high));
  if (unit == "m") return typical < kLeastMetres ? ShownUnit{"mm", 1e3} : ShownUnit{"m", 1.0};
  if (unit == "s") return time_unit(typical, 1.0);
  if (unit == "ms") return time_unit(typical, 1e-3);
  if (unit == "us") return time_unit(typical, 1e-6);
  if (unit == "deg") return {"°", 1.0};
  if (unit == "m^2") return {"m²", 1.0};
  if (unit == "deg^2") return {"°²", 1.0};
  return {unit, 1.0};
}

std::string with_unit(const std::string& label, const std::string& unit) {
  return unit.empty() ? label : fmt::format("{} [{}]", label, unit);
}

}  // namespace scanbench::render
