// polyline: maximum-likelihood polylines, walls that meet at shared vertices. A dynamic programme places the vertices;
// their number may be requested. Then all vertices are refined together in the coordinates of the beams. The objective
// is that of Schaefer, Buescher, Luft & Burgard, "A maximum likelihood approach to extract polylines from 2-D laser
// range scans", IROS 2018, under Gaussian noise; they remove vertices one by one. docs/algorithms/polyline.md.
#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Core>

#include "algorithms/extract/parts/beam_line.hpp"
#include "algorithms/extract/parts/groups.hpp"
#include "algorithms/extract/parts/scan_model.hpp"
#include "algorithms/extract/polyline/chain.hpp"
#include "algorithms/extract/polyline/search.hpp"
#include "core/index.hpp"
#include "core/modules.hpp"
#include "core/registry.hpp"
#include "core/special_values.hpp"

namespace scanbench::extract {
namespace {

/// The length of the shortest description that was found.
struct PolylineDescriptionRow {
  static constexpr std::string_view kName = "polyline_description_nats";
  double length_nats = 0.0;
  static constexpr auto columns() { return std::tuple{column("length_nats", &PolylineDescriptionRow::length_nats)}; }
};

constexpr double kNeverClutter = 1e6;  // [nats] for a return that must not be clutter
constexpr int kMostVertices = 64;      // limit if the description length determines their number
constexpr int kMostPlaces = 400;       // limit of points that may have a vertex in the search
constexpr int kSearches = 2;
constexpr int kClosedSearches = 4;  // from different vertices of the best chain so far

// A chain and the returns that it explains: `points` in the order of its bearings.
struct FittedChain {
  ChainFit fit;
  std::vector<int> points;
  double cost = 0.0;  ///< code length of its returns, apart from missing beams
};

class PolylineExtraction {
 public:
  PolylineExtraction(const Scan& scan, const SensorNoise& noise, int vertices, bool clutter)
      : scan_(scan), noise_(noise), vertices_(vertices), clutter_(clutter), model_(scan, noise) {}

  ScanLines run(SupportRules rules, Trace& trace) {
    if (model_.size() < 2) return lines_of_runs(scan_, model_.points(), {}, Fit::tls, rules);
    trace.stage(Stage::search);
    points_ = model_.segmentation_points({});
    for (SegmentationPoint& p : points_) {
      p.direction.y() *= mirror_;
      if (!clutter_) p.clutter_cost = kNeverClutter;
    }
    for (std::size_t i = 0; i < model_.size(); ++i)
      readings_.push_back({mirror_ * scan_.sensor.geometry.angle(model_.points().beams[i]), model_.ranges()[i],
                           reading_sigma(noise_, model_.smoothed_range(i), 0.0)});
    const int n = static_cast<int>(points_.size());
    stride_ = (n + kMostPlaces - 1) / kMostPlaces;
    vertex_cost_ = vertices_ > 0 ? 0.0 : 2.0 * model_.place_cost();
    search_open();
    search_closed();
    trace.row(PolylineDescriptionRow{cost_});
    return result(rules);
  }

 private:
  using Offsets = std::array<double, 7>;  // in standard deviations

  // Ranges for a vertex at each return: the reading, and a range (smoothed or of an earlier chain) with offsets of some
  // standard deviations.
  template <class RangeOfPoint>
  VertexChoices choices_around(const Offsets& offsets, RangeOfPoint range) const {
    VertexChoices choices;
    for (std::size_t i = 0; i < model_.size(); ++i) {
      const double r = range(i);
      choices.push_back({1.0 / readings_[i].range_m});
      for (const double k : offsets) choices.back().push_back(1.0 / std::max(r + k * readings_[i].sigma_m, 0.5 * r));
    }
    return choices;
  }
  VertexChoices choices_around_readings() const {
    return choices_around({0.0, -1.0, 1.0, -3.0, 3.0, -6.0, 6.0},
                          [&](std::size_t i) { return model_.smoothed_range(i); });
  }
  VertexChoices choices_around(const std::vector<FittedChain>& chains) const {
    std::vector<double> ranges(model_.size());
    for (std::size_t i = 0; i < ranges.size(); ++i) ranges[i] = model_.smoothed_range(i);
    double squares = 0.0, count = 1.0;
    for (const FittedChain& c : chains) {
      squares += 2.0 * c.fit.half_squares;
      count += static_cast<double>(c.points.size());
      for (const int i : c.points) {
        const Chain& chain = c.fit.chain;
        const double bearing = within(chain, readings_[as_index(i)].bearing_rad);
        ranges[as_index(i)] = 1.0 / chain.inverse_range(chain.wall_at(bearing), bearing);
      }
    }
    const double misfit = std::max(std::sqrt(squares / count), 1.0);  // in standard deviations
    Offsets offsets = {0.0, -0.5, 0.5, -1.0, 1.0, -2.0, 2.0};
    for (double& k : offsets) k *= misfit;
    return choices_around(offsets, [&](std::size_t i) { return ranges[i]; });
  }

  // Code length of all returns, by chains and as clutter, and of the vertices.
  double description(const std::vector<FittedChain>& chains) const {
    double cost = 0.0;
    for (const SegmentationPoint& p : points_) cost += p.clutter_cost;
    for (const FittedChain& chain : chains) {
      cost += chain.cost + vertex_cost_ * static_cast<double>(chain.fit.chain.vertices.size());
      for (const int i : chain.points) cost -= points_[as_index(i)].clutter_cost;
    }
    return cost;
  }
  void keep_if_shorter(std::vector<FittedChain> chains) {
    const double cost = description(chains);
    if (!(cost < cost_)) return;
    cost_ = cost;
    chains_ = std::move(chains);
  }

  // Searches on a grid around the readings, then on one around the chains that were found.
  void search_open() {
    const int most = std::min(vertices_ > 0 ? vertices_ : kMostVertices, static_cast<int>(points_.size()));
    for (int k = 0; k < kSearches; ++k) {
      const VertexChoices choices = k == 0 ? choices_around_readings() : choices_around(chains_);
      std::vector<FittedChain> chains;
      for (const auto& chain : best_chains(points_, choices, most, vertex_cost_, stride_).chains)
        chains.push_back(refined(chain, false));
      keep_if_shorter(std::move(chains));
    }
  }

  bool is_full_turn() const {
    const auto& g = scan_.sensor.geometry;
    return model_.size() == as_index(g.beams()) && std::fabs(g.angle_step()) * g.beams() > kTwoPi - 1e-6;
  }

  // A scan of a full turn may be one closed chain, which has one wall more than an open chain with as many vertices.
  // The search needs a first vertex. It takes the vertex of the chain before that is farthest from that chain's first
  // vertex.
  void search_closed() {
    if (!is_full_turn() || chains_.empty()) return;
    const auto& widest = *std::ranges::max_element(chains_, {}, [](const FittedChain& c) { return c.points.size(); });
    const GridVertex fixed = nearest_point(widest.fit.chain.vertices[widest.fit.chain.vertices.size() / 2]);
    if (vertices_ > 0) return search_closed(vertices_, fixed);
    // The two ends of the open chain are one vertex or inside a wall, and the grid may have added a vertex.
    const int open = static_cast<int>(widest.fit.chain.vertices.size());
    for (int v = open - 1; v >= 3; --v) {
      const double before = cost_;
      search_closed(v, fixed);
      if (v < open - 1 && !(cost_ < before)) break;
    }
  }
  void search_closed(int vertices, GridVertex fixed) {
    if (vertices < 3) return;
    VertexChoices choices = choices_around_readings();
    for (int k = 0; k < kClosedSearches; ++k) {
      const GridChains closed = best_closed_chain(points_, choices, vertices, stride_, fixed);
      if (closed.chains.empty()) return;
      auto chain = closed.chains.front();
      fixed = chain[chain.size() / 2];
      fixed.point %= static_cast<int>(points_.size());
      chain.pop_back();
      std::vector<FittedChain> found = {refined(chain, true)};
      choices = choices_around(found);
      keep_if_shorter(std::move(found));
    }
  }

  GridVertex nearest_point(const ChainVertex& v) const {
    const auto it = std::ranges::lower_bound(readings_, v.bearing_rad, {}, &BearingReading::bearing_rad);
    return {static_cast<int>(std::min(it, readings_.end() - 1) - readings_.begin()), v.inverse_range};
  }

  FittedChain refined(const std::vector<GridVertex>& grid, bool closed) {
    const int n = static_cast<int>(points_.size());
    FittedChain result;
    Chain start{.vertices = {}, .closed = closed};
    for (const GridVertex& v : grid)
      start.vertices.push_back(
          {readings_[as_index(v.point % n)].bearing_rad + (v.point >= n ? kTwoPi : 0.0), v.inverse_range});
    const int first = closed ? 0 : grid.front().point;
    const int last = closed ? n - 1 : grid.back().point;
    for (int i = first; i <= last; ++i) result.points.push_back(i);
    std::vector<BearingReading> readings(readings_.begin() + first, readings_.begin() + last + 1);
    result.fit = fit_chain(start, readings);
    if (noise_.bearing_sigma_rad > 0) {  // its effect depends on the obliqueness of the walls, which is known now
      for (BearingReading& z : readings) {
        const Chain& chain = result.fit.chain;
        const double bearing = within(chain, z.bearing_rad);
        const int wall = chain.wall_at(bearing);
        z.sigma_m = reading_sigma(noise_, 1.0 / chain.inverse_range(wall, bearing), chain.slope(wall, bearing));
      }
      result.fit = fit_chain(result.fit.chain, readings);
    }
    result.cost = result.fit.half_squares;
    for (const BearingReading& z : readings) result.cost += std::log(z.sigma_m * std::sqrt(kTwoPi));
    return result;
  }

  Vec2 place(const ChainVertex& v) const {
    return Vec2(std::cos(v.bearing_rad), mirror_ * std::sin(v.bearing_rad)) / v.inverse_range;
  }

  // Covariance of (offset at the midpoint, angle) of a wall, not mirrored.
  Eigen::Matrix2d wall_covariance(const ChainFit& fit, int wall, const Segment& s, const PolarLine& line) const {
    const int count = static_cast<int>(fit.chain.vertices.size());
    Eigen::Matrix<double, 2, 4> jacobian;
    const Vec2 along = s.direction();
    const Vec2 normal = line.normal();
    for (int end = 0; end < 2; ++end) {
      const ChainVertex v = fit.chain.vertex(wall + end);
      const Vec2 u(std::cos(v.bearing_rad), mirror_ * std::sin(v.bearing_rad));
      const Vec2 tangent(-std::sin(v.bearing_rad), mirror_ * std::cos(v.bearing_rad));
      const std::array<Vec2, 2> moves = {tangent / v.inverse_range, -u / (v.inverse_range * v.inverse_range)};
      for (int k = 0; k < 2; ++k) {
        const bool is_b = s.b.isApprox(place(v));
        jacobian(0, 2 * end + k) = 0.5 * normal.dot(moves[as_index(k)]);
        jacobian(1, 2 * end + k) = (is_b ? 1.0 : -1.0) * cross(along, moves[as_index(k)]) / s.length();
      }
    }
    Eigen::Matrix4d c;
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) {
        const auto index = [&](int k) { return 2 * ((wall + k / 2) % count) + k % 2; };
        c(i, j) = fit.covariance(index(i), index(j));
      }
    return jacobian * c * jacobian.transpose();
  }

  ScanLines result(SupportRules rules) const {
    std::vector<int> group(model_.size(), -1);
    std::vector<std::pair<const ChainFit*, int>> walls;  // chain and wall of each group
    for (const FittedChain& chain : chains_) {
      const int before = static_cast<int>(walls.size());
      for (int k = 0; k < chain.fit.chain.walls(); ++k) walls.emplace_back(&chain.fit, k);
      for (const int i : chain.points)
        group[as_index(i)] =
            before + chain.fit.chain.wall_at(within(chain.fit.chain, readings_[as_index(i)].bearing_rad));
    }
    ScanLines out = lines_of_groups(scan_, model_.points(), group, static_cast<int>(walls.size()), Fit::tls, rules);
    std::vector<int> group_of_beam(as_index(scan_.beams()), -1);
    for (std::size_t i = 0; i < model_.size(); ++i) group_of_beam[as_index(model_.points().beams[i])] = group[i];
    for (LineFeature& line : out.lines) {
      const auto& [fit, wall] = walls[as_index(group_of_beam[as_index(line.first_beam)])];
      line.segment = {place(fit->chain.vertex(wall)), place(fit->chain.vertex(wall + 1))};
      if (mirror_ < 0) std::swap(line.segment.a, line.segment.b);
      line.line = line_through(line.segment.a, line.segment.b);
      line.covariance = wall_covariance(*fit, wall, line.segment, line.line);
    }
    std::vector<double> squares(out.lines.size(), 0.0);
    for (std::size_t i = 0; i < model_.size(); ++i) {
      const int k = out.labels[as_index(model_.points().beams[i])];
      if (k >= 0)
        squares[as_index(k)] += std::pow(out.lines[as_index(k)].line.signed_distance(model_.points().points[i]), 2);
    }
    for (std::size_t k = 0; k < out.lines.size(); ++k) out.lines[k].rms_m = std::sqrt(squares[k] / out.lines[k].points);
    return out;
  }

  const Scan& scan_;
  const SensorNoise& noise_;
  int vertices_;
  bool clutter_;
  ScanModel model_;
  /// Mirrored, the scan of a scanner that rotates clockwise is counter-clockwise.
  double mirror_ = scan_.sensor.geometry.angle_step() < 0 ? -1.0 : 1.0;
  std::vector<SegmentationPoint> points_;  // mirrored
  std::vector<BearingReading> readings_;
  std::vector<FittedChain> chains_;
  double cost_ = kInf;
  double vertex_cost_ = 0.0;
  int stride_ = 1;
};

class Polyline final : public LineExtractor {
 public:
  struct Params {
    int vertices = 0;
    bool clutter = true;
    int min_points = 2;
    double min_length_m = 0.0;
    static auto fields() {
      return std::tuple_cat(
          std::tuple{field("vertices", &Params::vertices, between(0, 400), "",
                           "largest number of vertices of all polylines of a scan together, and the number of a closed "
                           "one; 0: as many as shorten the description"),
                     field("clutter", &Params::clutter,
                           "allow returns on no polyline, at the code length of a uniform range")},
          support_fields<Params>());
    }
  };

  explicit Polyline(const Params& p)
      : vertices_(p.vertices), clutter_(p.clutter), rules_{p.min_points, p.min_length_m} {}

  ScanLines extract(const Scan& scan, Trace& trace) const override {
    return PolylineExtraction(scan, scan.sensor.noise, vertices_, clutter_).run(rules_, trace);
  }

 private:
  int vertices_;
  bool clutter_;
  SupportRules rules_;
};

SCANBENCH_REGISTER(
    LineExtractor, Polyline,
    {.name = "polyline",
     .summary = "walls that share vertices: dynamic programme, then all vertices by maximum likelihood together",
     .reference = "docs/algorithms/polyline.md; objective after Schaefer, Buescher, Luft & Burgard 2018"});

}  // namespace
}  // namespace scanbench::extract
