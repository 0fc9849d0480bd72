// Geometric cooling from the start value to the end value.
#include "algorithms/align/ffs/schedule.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/number_text.hpp"

namespace scanbench::align::ffs {
namespace {

double geometric(double start, double end, int step, int steps) {
  if (steps <= 1 || step + 1 >= steps) return end;
  return start * std::pow(end / start, static_cast<double>(step) / (steps - 1));
}

}  // namespace

double Schedule::sigma_at(int iteration) const {
  return geometric(sigma_start_m, sigma_end_m, iteration, cooling_iterations);
}

double Schedule::step_at(int iteration) const {
  return geometric(step_start, step_end, iteration, cooling_iterations);
}

void Schedule::check() const {
  const auto refuse = [](const std::string& name, double value, const std::string& limit, double bound) {
    throw ParamError(name, name + " = " + number_text(value) + " is beyond " + limit + " = " + number_text(bound) +
                               "; allowed: up to " + limit);
  };
  if (sigma_end_m > sigma_start_m) refuse("sigma_end_m", sigma_end_m, "sigma_start_m", sigma_start_m);
  if (step_end > step_start) refuse("step_end", step_end, "step_start", step_start);
  if (cooling_iterations > max_iterations)
    refuse("cooling_iterations", cooling_iterations, "max_iterations", max_iterations);
}

}  // namespace scanbench::align::ffs
