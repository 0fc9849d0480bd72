// Forces over the runs of a cell grid.
#include "algorithms/align/ffs/force_field.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "algorithms/align/ffs/force_kernels.hpp"
#include "algorithms/align/parts/cell_grid.hpp"
#include "core/isa.hpp"

namespace scanbench::align::ffs {
namespace {

/// Points in the order of the cells of the grid, relative to its centre, with the sums of the forces on them.
struct FieldLanes {
  std::vector<float> x, y;
  std::vector<float> c, s;  ///< direction times weight
  std::vector<std::int32_t> body;
  std::vector<float> fx, fy, stiffness;
};

void all_pairs(const CellGrid& grid, const ForceArrays& points, const ForceConstants& constants,
               const ForceKernels& kernels) {
  const int around = grid.around();
  for (int row = 0; row < grid.rows(); ++row)
    for (int column = 0; column < grid.columns(); ++column) {
      const CellGrid::Run cell = grid.cell(row, column);
      if (cell.begin == cell.end) continue;
      const auto attract = [&](std::size_t begin, std::size_t end) {
        kernels.attract(points, constants, static_cast<int>(cell.begin), static_cast<int>(cell.end),
                        static_cast<int>(begin), static_cast<int>(end));
      };
      attract(cell.begin, grid.run(row, column, column + around).end);
      for (int above = row + 1; above <= row + around; ++above) {
        const CellGrid::Run run = grid.run(above, column - around, column + around);
        attract(run.begin, run.end);
      }
    }
}

FieldLanes lanes_of(const FieldPoints& points, const CellGrid& grid) {
  const std::size_t n = points.size(), padded = n + kForceLanes;
  FieldLanes lanes;
  for (auto* v : {&lanes.x, &lanes.y, &lanes.c, &lanes.s, &lanes.fx, &lanes.fy, &lanes.stiffness}) v->resize(padded);
  lanes.body.assign(padded, -1);
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t i = grid.order()[k];
    const Vec2 at = points.at[i] - grid.middle();
    const Vec2 weighted = points.weight[i] * points.direction[i];
    lanes.x[k] = static_cast<float>(at.x());
    lanes.y[k] = static_cast<float>(at.y());
    lanes.c[k] = static_cast<float>(weighted.x());
    lanes.s[k] = static_cast<float>(weighted.y());
    lanes.body[k] = points.body[i];
  }
  return lanes;
}

double peak(double sigma) {
  return 1.0 / (sigma * std::sqrt(2.0 * std::numbers::pi));
}

}  // namespace

void point_forces(const FieldPoints& points, const Field& field, std::vector<PointForce>& forces, Isa isa) {
  const CellGrid grid(points.at, field.reach());
  FieldLanes lanes = lanes_of(points, grid);
  const ForceArrays arrays{lanes.x.data(),    lanes.y.data(),  lanes.c.data(),  lanes.s.data(),
                           lanes.body.data(), lanes.fx.data(), lanes.fy.data(), lanes.stiffness.data()};
  const ForceConstants constants{static_cast<float>(-0.5 * std::numbers::log2e / (field.sigma * field.sigma)),
                                 static_cast<float>(field.reach() * field.reach()),
                                 static_cast<float>(1.0 / field.soft())};
  all_pairs(grid, arrays, constants, build_for(isa, baseline::kForceKernels, v3::kForceKernels));
  forces.resize(points.size());
  const double scale = peak(field.sigma);
  for (std::size_t k = 0; k < points.size(); ++k)
    forces[grid.order()[k]] = {scale * Vec2(lanes.fx[k], lanes.fy[k]), scale * static_cast<double>(lanes.stiffness[k])};
}

double stiffness_on_line(double spacing_m, const Field& field) {
  double sum = 0.0;
  const auto points = static_cast<std::int64_t>(field.reach() / spacing_m + 0.5);  // of either side
  for (std::int64_t k = 0; k < points; ++k) {
    const double d = (static_cast<double>(k) + 0.5) * spacing_m;
    sum += 2.0 * std::exp(-0.5 * d * d / (field.sigma * field.sigma)) / std::max(d, field.soft());
  }
  return peak(field.sigma) * sum;
}

double potential(const FieldPoints& points, const Field& field) {
  const CellGrid grid(points.at, field.reach());
  const double scale = 1.0 / (field.sigma * std::numbers::sqrt2), soft = field.soft();
  const auto gauss = [&](double d) { return std::exp(-scale * scale * d * d); };
  double sum = 0.0;
  for (std::size_t v = 0; v < points.size(); ++v)
    grid.for_each_near(points.at[v], [&](std::size_t u) {
      if (u <= v || points.body[u] == points.body[v]) return;
      const double d = (points.at[u] - points.at[v]).norm();
      if (d > field.reach()) return;
      const double aligned = std::fabs(points.direction[u].dot(points.direction[v]));
      double depth = 0.5 * std::erfc(std::max(d, soft) * scale);
      if (d < soft) depth += peak(field.sigma) * field.sigma * field.sigma / soft * (gauss(d) - gauss(soft));
      sum -= points.weight[u] * points.weight[v] * aligned * depth;
    });
  return sum;
}

}  // namespace scanbench::align::ffs
