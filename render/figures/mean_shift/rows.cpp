#include "render/figures/mean_shift/rows.hpp"
#include "render/figures/parts/clusters.hpp"
#include "render/figures/parts/style.hpp"

#include <algorithm>
#include <cmath>

namespace scanbench::render {
namespace {

using Row = std::vector<double>;

/// Calls visit(row) for the rows of this name that have this many numbers.
template <class Visit>
void for_rows(const TraceRows& trace, std::string_view name, std::size_t numbers, Visit&& visit) {
  const auto found = trace.find("merge." + std::string(name));
  if (found == trace.end()) return;
  for (const TraceRow& row : found->second)
    if (row.values.size() == numbers) visit(row.values);
}

/// The element at a row's index; nullptr beyond the end.
template <class T>
T* element(std::vector<T>& all, double index) {
  return index >= 0 && index < static_cast<double>(all.size()) ? &all[static_cast<std::size_t>(index)] : nullptr;
}

/// The same in a list that grows to hold it.
CollinearCluster* cluster_at(std::vector<CollinearCluster>& all, double index, std::size_t pieces) {
  if (!(index >= 0) || !(index < static_cast<double>(pieces))) return nullptr;  // a cluster has a piece
  all.resize(std::max(all.size(), static_cast<std::size_t>(index) + 1));
  return &all[static_cast<std::size_t>(index)];
}

ClusteredSegments clustered(const MeanShiftRows& rows, int MergePiece::*of) {
  std::vector<int> cluster;
  for (const MergePiece& piece : rows.pieces) cluster.push_back(piece.*of);
  return {rows.segments(), std::move(cluster)};
}

MeanShiftRows parsed(const std::string& pipeline, const TraceRows& trace) {
  MeanShiftRows rows{.pipeline = pipeline};
  for_rows(trace, "counts", 6, [&](const Row& v) { rows.lines = v[0] > 0 ? static_cast<std::size_t>(v[0]) : 0; });
  for_rows(trace, "kernel1", 2, [&](const Row& v) { rows.sigma_m = v[0], rows.h_rad_per_m = v[1]; });
  for_rows(trace, "joint_space", 6, [&](const Row& v) {
    const Vec2 center(v[2], v[3]), half = 0.5 * v[5] * Vec2(std::cos(v[4]), std::sin(v[4]));
    rows.pieces.push_back({.segment = {center - half, center + half}, .point = {v[2], v[3], v[4]}});
  });
  const std::size_t pieces = rows.pieces.size();
  const auto number = [&](double v) { return v >= 0 && v < static_cast<double>(pieces) ? static_cast<int>(v) : -1; };
  for_rows(trace, "cluster", 4, [&](const Row& v) {
    if (MergePiece* piece = element(rows.pieces, v[0])) piece->cluster1 = number(v[1]), piece->cluster2 = number(v[2]);
  });
  rows.paths.resize(rows.pieces.size());
  for_rows(trace, "trajectory1", 5, [&](const Row& v) {
    if (auto* path = element(rows.paths, v[0])) path->emplace_back(v[2], v[3], v[4]);
  });
  for_rows(trace, "mode1", 4, [&](const Row& v) { rows.ends.emplace_back(v[1], v[2], v[3]); });

  for_rows(trace, "mode2", 4, [&](const Row& v) {
    if (auto* c = cluster_at(rows.collinear, v[0], pieces)) c->mode = Vec2(v[1], v[2]), c->theta_rad = v[3];
  });
  for_rows(trace, "kernel2", 6, [&](const Row& v) {
    if (auto* c = cluster_at(rows.collinear, v[0], pieces))
      c->kernel = Ellipse{.center = {v[1], v[2]}, .semi_axes = {v[4], v[5]}, .angle_rad = v[3]};
  });
  for_rows(trace, "projection", 6, [&](const Row& v) {
    auto* c = cluster_at(rows.collinear, v[0], pieces);
    if (c != nullptr && element(rows.pieces, v[1]) != nullptr)
      c->projections.push_back({static_cast<std::size_t>(v[1]), {{v[2], v[3]}, {v[4], v[5]}}});
  });
  for_rows(trace, "merged", 5, [&](const Row& v) {
    if (auto* c = cluster_at(rows.collinear, v[0], pieces)) c->merged.push_back({{v[1], v[2]}, {v[3], v[4]}});
  });
  for_rows(trace, "interval", 4, [&](const Row& v) { rows.map.push_back({{v[0], v[1]}, {v[2], v[3]}}); });
  return rows;
}

}  // namespace

std::vector<Segment> MeanShiftRows::segments() const {
  std::vector<Segment> all;
  for (const MergePiece& piece : pieces) all.push_back(piece.segment);
  return all;
}

std::string MeanShiftRows::counted_pieces() const {
  const std::string given = counted(lines, "segment");
  return pieces.size() > lines ? counted(pieces.size(), "piece") + " of " + given : given;
}

ClusteredSegments MeanShiftRows::by_direction() const {
  return clustered(*this, &MergePiece::cluster1);
}

ClusteredSegments MeanShiftRows::by_collinearity() const {
  return clustered(*this, &MergePiece::cluster2);
}

std::vector<std::string> rows_of_mean_shift(std::initializer_list<std::string> names) {
  std::vector<std::string> all{"merge.counts"};
  for (const std::string& name : names) all.push_back("merge." + name);
  return all;
}

std::optional<MeanShiftRows> find_mean_shift(const FigureInput& input, const std::string& pipeline) {
  for (const NamedResult& named : input.results) {
    if (named.trace == nullptr || !shows(pipeline, named.pipeline)) continue;
    if (named.trace->contains("merge.counts")) return parsed(named.pipeline, *named.trace);
  }
  return std::nullopt;
}

Vec3 on_axes(const Vec3& point) {
  return {point.x(), point.y(), degrees(point.z())};
}

View3 joint_space_view(const MeanShiftRows& rows) {
  Vec2 low(INFINITY, INFINITY), high = -low;
  for (const MergePiece& piece : rows.pieces)
    for (const Vec2& p : {piece.segment.a, piece.segment.b}) low = low.cwiseMin(p), high = high.cwiseMax(p);
  if (rows.pieces.empty()) low = Vec2(0, 0), high = Vec2(1, 1);
  const double margin = 0.04 * std::max((high - low).maxCoeff(), 0.5);
  // The seam is named where it is: a point at the top is a neighbour of one on the floor.
  const Axis3 direction{
      "direction [deg]", 0.0, 180.0, {{0, "0"}, {45, "45"}, {90, "90"}, {135, "135"}, {180, "180 = 0"}}};
  return View3({Axis3{"x [m]", low.x() - margin, high.x() + margin, {}},
                Axis3{"y [m]", low.y() - margin, high.y() + margin, {}}, direction},
               {});
}

}  // namespace scanbench::render
