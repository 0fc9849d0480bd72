// Reads the trace rows of mean_shift into the structs of its figures.
#include "render/figures/mean_shift/rows.hpp"
#include "render/figures/parts/clusters.hpp"
#include "render/figures/parts/style.hpp"

#include <algorithm>
#include <cmath>

namespace scanbench::render {
namespace {

using namespace mean_shift;

/// The element with this index; nullptr beyond the ends.
template <class T>
T* element(std::vector<T>& all, int index) {
  return index >= 0 && index < std::ssize(all) ? &all[static_cast<std::size_t>(index)] : nullptr;
}

/// The same in a list that grows to contain it.
CollinearCluster* cluster_at(std::vector<CollinearCluster>& all, int index, std::size_t pieces) {
  if (index < 0 || static_cast<std::size_t>(index) >= pieces) return nullptr;  // every cluster has a piece
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
  for (const auto& r : rows_of<CountsRow>(trace, kMergeSlot))
    rows.lines = r.lines > 0 ? static_cast<std::size_t>(r.lines) : 0;
  for (const auto& r : rows_of<Kernel1Row>(trace, kMergeSlot))
    rows.sigma_m = r.sigma_m, rows.h_rad_per_m = r.h_rad_per_m;
  for (const auto& r : rows_of<JointSpaceRow>(trace, kMergeSlot)) {
    const Vec2 center(r.x_m, r.y_m), half = 0.5 * r.length_m * Vec2(std::cos(r.alpha_rad), std::sin(r.alpha_rad));
    rows.pieces.push_back({.segment = {center - half, center + half}, .point = {r.x_m, r.y_m, r.alpha_rad}});
  }
  const std::size_t pieces = rows.pieces.size();
  const auto known = [&](int cluster) { return cluster < std::ssize(rows.pieces) ? std::max(cluster, -1) : -1; };
  for (const auto& r : rows_of<ClusterRow>(trace, kMergeSlot))
    if (MergePiece* piece = element(rows.pieces, r.piece))
      piece->cluster1 = known(r.cluster1), piece->cluster2 = known(r.cluster2);
  rows.paths.resize(pieces);
  for (const auto& r : rows_of<TrajectoryRow<1>>(trace, kMergeSlot))
    if (auto* path = element(rows.paths, r.piece)) path->emplace_back(r.x_m, r.y_m, r.alpha_rad);
  for (const auto& r : rows_of<Mode1Row>(trace, kMergeSlot)) rows.ends.emplace_back(r.x_m, r.y_m, r.alpha_rad);

  const auto cluster = [&](int index) { return cluster_at(rows.collinear, index, pieces); };
  for (const auto& r : rows_of<Mode2Row>(trace, kMergeSlot))
    if (auto* c = cluster(r.cluster)) c->mode = Vec2(r.x_m, r.y_m), c->theta_rad = r.theta_rad;
  for (const auto& r : rows_of<Kernel2Row>(trace, kMergeSlot))
    if (auto* c = cluster(r.cluster))
      c->kernel = Ellipse{.center = {r.x_m, r.y_m}, .semi_axes = {r.sigma_x_m, r.sigma_y_m}, .angle_rad = r.axis_rad};
  for (const auto& r : rows_of<ProjectionRow>(trace, kMergeSlot))
    if (auto* c = cluster(r.cluster); c != nullptr && element(rows.pieces, r.piece) != nullptr)
      c->projections.push_back({static_cast<std::size_t>(r.piece), {{r.x1_m, r.y1_m}, {r.x2_m, r.y2_m}}});
  for (const auto& r : rows_of<MergedRow>(trace, kMergeSlot))
    if (auto* c = cluster(r.cluster)) c->merged.push_back({{r.x1_m, r.y1_m}, {r.x2_m, r.y2_m}});
  for (const auto& r : rows_of<IntervalRow>(trace, kMergeSlot))
    rows.map.push_back({{r.x1_m, r.y1_m}, {r.x2_m, r.y2_m}});
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

std::optional<MeanShiftRows> find_mean_shift(const FigureInput& input, const std::string& pipeline) {
  for (const NamedResult& named : input.results) {
    if (named.trace == nullptr || !shows(pipeline, named.pipeline)) continue;
    if (named.trace->contains(key_of<mean_shift::CountsRow>(kMergeSlot))) return parsed(named.pipeline, *named.trace);
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
  // The label 180 = 0 names the seam: a point at the top is a neighbour of one on the floor.
  const Axis3 direction{
      "direction [°]", 0.0, 180.0, {{0, "0"}, {45, "45"}, {90, "90"}, {135, "135"}, {180, "180 = 0"}}};
  return View3({Axis3{"x [m]", low.x() - margin, high.x() + margin, {}},
                Axis3{"y [m]", low.y() - margin, high.y() + margin, {}}, direction},
               {});
}

}  // namespace scanbench::render
