// Templates of modules: @name@ and @Name@ are replaced.
#include "app/authoring/module_templates.hpp"

#include <algorithm>
#include <array>
#include <cctype>

#include "core/error.hpp"
#include "core/names.hpp"

namespace scanbench::app {
namespace {

constexpr std::string_view kExtract = R"text(// @name@: one line through all returns.
#include "core/geometry/least_squares.hpp"
#include "core/modules.hpp"
#include "core/registry.hpp"

namespace scanbench {
namespace {

class @Name@ final : public LineExtractor {
 public:
  struct Params {
    int min_points = 2;
    static auto fields() {
      return std::tuple{field("min_points", &Params::min_points, at_least(2), "", "fewest returns that make a line")};
    }
  };
  explicit @Name@(Params params) : params_(params) {}

  ScanLines extract(const Scan& scan, Trace& trace) const override {
    trace.stage(Stage::segment);
    ScanLines found{{}, std::vector<int>(static_cast<std::size_t>(scan.beams()), -1)};
    const ScanPoints points = valid_points(scan);
    if (static_cast<int>(points.size()) < params_.min_points) return found;
    const LineFit fit = fit_line(points.points);
    if (fit.degenerate) return found;  // all returns at one point
    LineFeature line;
    line.segment = seen_from_origin(fit.project(points.points.front()), fit.project(points.points.back()));
    line.line = fit.polar();
    line.first_beam = points.beams.front();
    line.last_beam = points.beams.back();
    line.points = static_cast<int>(points.size());
    line.rms_m = fit.rms();
    for (const int beam : points.beams) found.labels[static_cast<std::size_t>(beam)] = 0;
    found.lines.push_back(line);
    return found;
  }

 private:
  Params params_;
};

const bool registered = Registry<LineExtractor>::add<@Name@>(
    {.name = "@name@", .summary = "one line through all returns", .reference = "none"});

}  // namespace
}  // namespace scanbench
)text";

constexpr std::string_view kAlign = R"text(// @name@: the points of every scan on the lines of the first.
#include <algorithm>
#include <vector>

#include <Eigen/Dense>

#include "core/modules.hpp"
#include "core/registry.hpp"

namespace scanbench {
namespace {

/// Moves a scan so that its points lie on walls: Gauss-Newton steps over the distances of the points from the
/// nearest wall. The pose is that of the scan in the frame of the walls; it stays if the walls do not
/// determine it.
Status fit_points_to_walls(const Scan& scan, const std::vector<Segment>& walls, double max_distance_m,
                           int max_iterations, Pose2& pose) {
  const std::vector<Vec2> points = valid_points(scan).points;
  for (int iteration = 0; iteration < max_iterations; ++iteration) {
    Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
    Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
    for (const Vec2& p : points) {
      const Vec2 q = pose * p;
      const auto near = std::ranges::min_element(walls, {}, [&](const Segment& wall) { return distance(q, wall); });
      if (near == walls.end() || !(distance(q, *near) <= max_distance_m)) continue;
      // The residual is n . (pose p - a); the unknowns are a step (x, y, yaw) in the scan's own frame.
      const Vec2 normal = perpendicular(near->direction());
      const Vec2 own_normal = pose.inverse().rotate(normal);
      const Eigen::Vector3d jacobian(own_normal.x(), own_normal.y(), cross(p, own_normal));
      information += jacobian * jacobian.transpose();
      gradient += jacobian * normal.dot(q - near->a);
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> parts(information);
    if (!(parts.eigenvalues().minCoeff() > 1e-9 * parts.eigenvalues().maxCoeff())) return Status::degenerate;
    const Eigen::Vector3d step = -information.ldlt().solve(gradient);
    if (!step.allFinite()) return Status::degenerate;
    pose = pose * Pose2::exp(step);
    if (step.norm() < 1e-9) return Status::converged;
  }
  return Status::max_iterations;
}

class @Name@ final : public Aligner {
 public:
  struct Params {
    double max_distance_m = 0.5;
    int max_iterations = 50;
    static auto fields() {
      return std::tuple{field("max_distance_m", &Params::max_distance_m, above(0), "m",
                              "largest distance of a point from the line that it is paired with"),
                        field("max_iterations", &Params::max_iterations, between(1, 1000), "", "most steps of a scan")};
    }
  };
  explicit @Name@(Params params) : params_(params) {}

  Alignment align(std::span<const Observation> scans, std::span<const Pose2> initial, Trace& trace) const override {
    trace.stage(Stage::one_by_one);
    Alignment result{Status::converged, {initial.begin(), initial.end()}};
    if (scans.empty()) return result;
    std::vector<Segment> walls;
    for (const LineFeature& line : scans[0].lines.lines) walls.push_back(initial[0] * line.segment);
    for (std::size_t k = 1; k < scans.size(); ++k) {
      const Status status = fit_points_to_walls(scans[k].scan, walls, params_.max_distance_m, params_.max_iterations,
                                                result.world_from_sensor[k]);
      if (status != Status::converged) result.status = status;
    }
    return result;
  }

 private:
  Params params_;
};

const bool registered = Registry<Aligner>::add<@Name@>(
    {.name = "@name@", .summary = "the points of every scan on the lines of the first", .reference = "none"});

}  // namespace
}  // namespace scanbench
)text";

constexpr std::string_view kMatch =
    R"text(// @name@: the returns of a scan on the lines through their partners in another.
#include "algorithms/match/parts/point_line_registration.hpp"
#include "core/modules.hpp"
#include "core/registry.hpp"

namespace scanbench {
namespace {

class @Name@ final : public ScanMatcher {
 public:
  struct Params {
    double gate_m = 0.5;
    double min_overlap = 0.3;
    int max_iterations = 30;
    static auto fields() {
      return std::tuple{field("gate_m", &Params::gate_m, between(1e-6, 1e6), "m", "farthest partner of a return"),
                        field("min_overlap", &Params::min_overlap, between(0, 1), "",
                              "smallest share of returns with a partner; below it there is no match"),
                        field("max_iterations", &Params::max_iterations, between(1, 1e6), "", "iterations at most")};
    }
  };
  explicit @Name@(Params params)
      : rules_{.gate_m = params.gate_m,
               .keep = 0.9,
               .trim = 4.5,
               .by_noise = true,
               .min_overlap = params.min_overlap,
               .max_iterations = params.max_iterations} {}

  // Lines that the slot before found are in reference.lines and current.lines; this matcher takes the returns.
  Match match(const Observation& reference, const Observation& current, const Pose2& guess,
              Trace& trace) const override {
    trace.stage(Stage::iterate);
    const matching::ReturnedPoints seen = matching::returned_points(reference.scan);
    const matching::ReturnedPoints now = matching::returned_points(current.scan);
    return matching::register_points_on_lines(seen, matching::local_lines(seen), now, matching::local_lines(now), guess,
                                              rules_, trace);
  }

 private:
  matching::RegistrationRules rules_;
};

const bool registered = Registry<ScanMatcher>::add<@Name@>(
    {.name = "@name@", .summary = "the returns of a scan on lines through those of another", .reference = "none"});

}  // namespace
}  // namespace scanbench
)text";

constexpr std::string_view kMerge =
    R"text(// @name@: one line for each set of segments that are close and parallel, directly or through others.
#include <algorithm>
#include <map>
#include <vector>

#include "core/disjoint_sets.hpp"
#include "core/geometry/least_squares.hpp"
#include "core/index.hpp"
#include "core/modules.hpp"
#include "core/registry.hpp"
#include "core/special_values.hpp"

namespace scanbench {
namespace {

bool is_usable(const Segment& s) {
  return s.a.allFinite() && s.b.allFinite() && s.length() > 0;
}

/// What is known of a line of the map while its members are added.
struct Sum {
  PointMoments ends;  ///< of the members' end points, weighted by length
  Vec2 direction = Vec2::Zero();
  int members = 0;
  int points = 0;
  double first_m = kInf;  ///< extent of the members along the line
  double last_m = -kInf;
};

class @Name@ final : public SegmentMerger {
 public:
  struct Params {
    double max_angle_deg = 10.0;
    double max_distance_m = 0.10;
    static auto fields() {
      return std::tuple{field("max_angle_deg", &Params::max_angle_deg, between(0, 90), "deg",
                              "largest angle between two segments of a line"),
                        field("max_distance_m", &Params::max_distance_m, at_least(0), "m",
                              "largest distance of an end of one segment from the other")};
    }
  };
  explicit @Name@(Params params) : params_(params) {}

  MergeResult merge(const MergeInput& input, Trace& trace) const override {
    trace.stage(Stage::match);
    const std::size_t count = input.lines.size();
    DisjointSets sets(count);
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (belong_together(input.lines[i].segment, input.lines[j].segment)) sets.unite(i, j);

    trace.stage(Stage::merge);
    const std::vector<int> set_of = sets.labels();
    std::map<int, Sum> sums;
    for (std::size_t i = 0; i < count; ++i)
      if (is_usable(input.lines[i].segment)) add(input.lines[i], sums[set_of[i]]);
    MergeResult result;
    result.labels.assign(count, -1);
    if (sums.empty()) result.status = Status::degenerate;
    for (auto& [set, sum] : sums) {
      const LineFit fit = fit_line(sum.ends);
      Vec2 along = -perpendicular(fit.normal);
      if (along.dot(sum.direction) < 0) along = -along;
      for (std::size_t i = 0; i < count; ++i) {
        if (set_of[i] != set) continue;
        result.labels[i] = static_cast<int>(result.map.lines.size());
        for (const Vec2& end : {input.lines[i].segment.a, input.lines[i].segment.b}) {
          sum.first_m = std::min(sum.first_m, along.dot(end - fit.centroid));
          sum.last_m = std::max(sum.last_m, along.dot(end - fit.centroid));
        }
      }
      MapLine line;
      line.segment = {fit.centroid + sum.first_m * along, fit.centroid + sum.last_m * along};
      line.members = sum.members;
      line.points = sum.points;
      result.map.lines.push_back(line);
    }
    return result;
  }

 private:
  bool belong_together(const Segment& s, const Segment& t) const {
    if (!is_usable(s) || !is_usable(t) || angle_between(s, t) > radians(params_.max_angle_deg)) return false;
    return std::min({distance(s.a, t), distance(s.b, t), distance(t.a, s), distance(t.b, s)}) <= params_.max_distance_m;
  }

  static void add(const MapLine& line, Sum& sum) {
    sum.ends.add(line.segment.a, line.segment.length());
    sum.ends.add(line.segment.b, line.segment.length());
    sum.direction += line.segment.b - line.segment.a;
    sum.members += line.members;
    sum.points += line.points;
  }

  Params params_;
};

const bool registered = Registry<SegmentMerger>::add<@Name@>(
    {.name = "@name@", .summary = "one line for each set of close and parallel segments", .reference = "none"});

}  // namespace
}  // namespace scanbench
)text";

struct Template {
  std::string_view kind;
  std::string_view text;
};
constexpr std::array kTemplates = {Template{"extract", kExtract}, Template{"match", kMatch}, Template{"align", kAlign},
                                   Template{"merge", kMerge}};

void replace_all(std::string& text, std::string_view from, std::string_view to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
}

std::string camel_case(std::string_view name) {
  std::string result;
  bool begins_word = true;
  for (const char c : name) {
    if (c != '_') result += begins_word ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : c;
    begins_word = c == '_';
  }
  return result;
}

}  // namespace

std::vector<std::string> template_kinds() {
  std::vector<std::string> kinds;
  kinds.reserve(kTemplates.size());
  for (const Template& each : kTemplates) kinds.emplace_back(each.kind);
  return kinds;
}

std::string module_source(std::string_view kind, std::string_view name) {
  const auto found = std::ranges::find(kTemplates, kind, &Template::kind);
  if (found == kTemplates.end())
    throw ConfigError("there is no template for the kind '" + std::string(kind) + "'" +
                      known_names(kind, template_kinds()));
  std::string text(found->text);
  replace_all(text, "@name@", name);
  replace_all(text, "@Name@", camel_case(name));
  return text;
}

}  // namespace scanbench::app
