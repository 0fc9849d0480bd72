// Non-blurring Gaussian mean shift of a point set (Lakaemper 2009, section III, eq. 1).
//
// Climbs are independent of each other and run box by box. All climbs in a box share one list of candidates. A climb
// that leaves its box continues in the next round, in which climbs are sorted by box. The kernel is cut off during
// climbs. One end per mode is polished in double, with a kernel cut off at 6.5.
#include "algorithms/merge/mean_shift/modes.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <unordered_map>

#include "algorithms/merge/mean_shift/climb.hpp"
#include "algorithms/merge/mean_shift/mode_polish.hpp"
#include "core/error.hpp"
#include "core/index.hpp"

namespace scanbench::merge {
namespace {

constexpr double kBox = 1.0;         // side of a box
constexpr double kHysteresis = 0.1;  // distance by which a climb may leave its box before it changes to the next
constexpr double kMargin =
    kHysteresis + kLongestFastStep + 1e-3;  // distance from the box up to which candidates are complete
constexpr double kSame = 2e-3;              // ends of climbs this close are one mode: they are converged to 1e-5
constexpr double kSamePolished = 1e-5;
constexpr double kGradientGoal = 1e-6;

struct BoxKey {
  std::int64_t x;
  std::int64_t y;
  std::int64_t z;
  auto operator<=>(const BoxKey&) const = default;
};

struct BoxHash {
  std::size_t operator()(const BoxKey& k) const {
    auto h = static_cast<std::uint64_t>(k.x) * 0x9E3779B97F4A7C15ULL;
    h = (h ^ (h >> 29) ^ static_cast<std::uint64_t>(k.y)) * 0xBF58476D1CE4E5B9ULL;
    h = (h ^ (h >> 32) ^ static_cast<std::uint64_t>(k.z)) * 0x94D049BB133111EBULL;
    return h ^ (h >> 31);
  }
};

/// Boxes of side 1 in x and y, and in z of a side that divides the period.
class Boxes {
 public:
  explicit Boxes(double period) {
    if (period > 0) {
      count_z_ = std::max<std::int64_t>(1, static_cast<std::int64_t>(period / kBox));
      side_z_ = period / static_cast<double>(count_z_);
    }
  }
  BoxKey key(const Vec3& p) const {
    return {floor_of(p.x() / kBox), floor_of(p.y() / kBox), wrap_z(floor_of(p.z() / side_z_))};
  }
  Vec3 centre(const BoxKey& k) const {
    return {(static_cast<double>(k.x) + 0.5) * kBox, (static_cast<double>(k.y) + 0.5) * kBox,
            (static_cast<double>(k.z) + 0.5) * side_z_};
  }
  /// Half sides, grown by a margin.
  Vec3 half(double margin) const { return {0.5 * kBox + margin, 0.5 * kBox + margin, 0.5 * side_z_ + margin}; }
  std::int64_t wrap_z(std::int64_t z) const { return count_z_ > 0 ? ((z % count_z_) + count_z_) % count_z_ : z; }

 private:
  static std::int64_t floor_of(double v) { return static_cast<std::int64_t>(std::floor(v)); }

  std::int64_t count_z_ = 0;
  double side_z_ = kBox;
};

struct PendingClimb {
  BoxKey box;
  std::size_t start;  // index of the point
  Vec3 at;
  int steps = 0;
};

class ModeSearch {
 public:
  ModeSearch(std::span<const Vec3> points, const ModeOptions& options, std::vector<std::vector<Vec3>>* paths)
      : points_(points), options_(options), paths_(paths), grid_(points, kBox, options.period), boxes_(options.period) {
    rules_.squared_cutoff = static_cast<float>(options.cutoff * options.cutoff);
    rules_.tolerance = static_cast<float>(options.tolerance);
    rules_.max_steps = options.max_steps;
    rules_.capture = options.capture;
    rules_.accelerate = options.accelerate;
    rules_.inner = Float3::rounded(boxes_.half(kHysteresis));
    rules_.outer = Float3::rounded(boxes_.half(kMargin));
    neighbours_ = [this](const Vec3& centre, std::vector<Vec3>& differences) {
      differences.clear();
      grid_.for_each_near(centre, Vec3::Constant(kPolishBox + kLongestPolishStep), kPolishCutoff,
                          [&](std::size_t, const Vec3& d) { differences.push_back(d); });
    };
  }

  Modes run();

 private:
  static constexpr double kLongestPolishStep = 0.5;  // a step from inside the box may end outside

  struct KnownEnd {
    Vec3 at;
    double radius;
    int mode;
  };

  void process_box(std::span<PendingClimb> climbs, std::vector<PendingClimb>& next);
  void collect_anchors(const BoxKey& box, const Vec3& centre);
  int adopt_end(const Vec3& end, bool* is_new_end);
  int mode_of_end(const Vec3& end);
  void remember(const Vec3& end, double radius, int mode);

  std::span<const Vec3> points_;
  const ModeOptions& options_;
  std::vector<std::vector<Vec3>>* paths_;
  PointGrid grid_;
  Boxes boxes_;
  ClimbRules rules_;
  Neighbours neighbours_;
  CandidateList candidates_;
  std::vector<Anchor> anchors_;
  std::vector<Float3> path_;
  std::vector<KnownEnd> ends_;
  std::int64_t lowest_end_ = std::numeric_limits<std::int64_t>::max();  // of the boxes with ends, in z
  std::int64_t highest_end_ = std::numeric_limits<std::int64_t>::min();
  std::unordered_map<BoxKey, std::vector<int>, BoxHash> ends_in_box_;
  std::unordered_map<BoxKey, std::vector<int>, BoxHash> modes_in_box_;
  Modes result_;
};

/// Calls visit(key) for the box and its neighbours, each once.
template <class Visit>
void for_each_neighbour(const Boxes& boxes, const BoxKey& box, Visit&& visit) {
  std::array<std::int64_t, 3> zs{boxes.wrap_z(box.z - 1), box.z, boxes.wrap_z(box.z + 1)};
  std::sort(zs.begin(), zs.end());
  const auto zs_end = std::unique(zs.begin(), zs.end());
  for (std::int64_t x = box.x - 1; x <= box.x + 1; ++x)
    for (std::int64_t y = box.y - 1; y <= box.y + 1; ++y)
      for (auto z = zs.begin(); z != zs_end; ++z) visit(BoxKey{x, y, *z});
}

Modes ModeSearch::run() {
  const std::size_t n = points_.size();
  result_.mode_of.assign(n, -1);
  if (paths_ != nullptr) paths_->assign(n, {});

  // Equal points climb once and have the result of the first of them.
  std::vector<std::size_t> order(n);
  for (std::size_t i = 0; i < n; ++i) order[i] = i;
  const auto key_of = [&](std::size_t i) { return std::array{points_[i].x(), points_[i].y(), points_[i].z()}; };
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return std::pair(key_of(a), a) < std::pair(key_of(b), b); });
  std::vector<std::size_t> first_equal(n);
  std::vector<PendingClimb> pending;
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t i = order[k];
    const bool repeated = k > 0 && points_[i] == points_[order[k - 1]];
    first_equal[i] = repeated ? first_equal[order[k - 1]] : i;
    if (!repeated) pending.push_back({boxes_.key(points_[i]), i, points_[i], 0});
    if (paths_ != nullptr) (*paths_)[i].push_back(points_[i]);
  }

  std::vector<PendingClimb> next;
  while (!pending.empty()) {
    std::sort(pending.begin(), pending.end(), [](const PendingClimb& a, const PendingClimb& b) {
      return a.box != b.box ? a.box < b.box : a.start < b.start;
    });
    next.clear();
    for (std::size_t begin = 0; begin < pending.size();) {
      std::size_t end = begin + 1;
      while (end < pending.size() && pending[end].box == pending[begin].box) ++end;
      process_box(std::span(pending).subspan(begin, end - begin), next);
      begin = end;
    }
    pending.swap(next);
  }

  for (std::size_t i = 0; i < n; ++i) {
    result_.mode_of[i] = result_.mode_of[first_equal[i]];
    if (paths_ == nullptr) continue;
    if (first_equal[i] != i)
      (*paths_)[i] = (*paths_)[first_equal[i]];
    else
      (*paths_)[i].push_back(result_.positions[as_index(result_.mode_of[i])]);
  }
  return std::move(result_);
}

void ModeSearch::process_box(std::span<PendingClimb> climbs, std::vector<PendingClimb>& next) {
  const BoxKey box = climbs.front().box;
  const Vec3 centre = boxes_.centre(box);
  candidates_.clear();
  candidates_.add_near(grid_, centre, boxes_.half(kMargin), options_.cutoff + 1e-3);
  candidates_.seal();
  collect_anchors(box, centre);

  for (PendingClimb& pending : climbs) {
    Vec3 from_centre = pending.at - centre;
    from_centre.z() = wrapped(from_centre.z(), options_.period);
    Float3 t = Float3::rounded(from_centre);
    int captured_by = -1;
    path_.clear();
    const ClimbEnd end =
        climb(candidates_, anchors_, rules_, t, pending.steps, captured_by, paths_ != nullptr ? &path_ : nullptr);
    const auto absolute = [&](const Float3& p) {
      Vec3 v = centre + Vec3(p.x, p.y, p.z);
      v.z() = reduced(v.z(), options_.period);
      return v;
    };
    if (paths_ != nullptr)
      for (const Float3& p : path_) (*paths_)[pending.start].push_back(absolute(p));
    int& mode = result_.mode_of[pending.start];
    if (end == ClimbEnd::captured) {
      mode = anchors_[as_index(captured_by)].mode;
    } else if (end == ClimbEnd::left_box) {
      pending.at = absolute(t);
      next.push_back({boxes_.key(pending.at), pending.start, pending.at, pending.steps});
    } else {
      if (end == ClimbEnd::exhausted) result_.converged = false;
      bool is_new_end = false;
      mode = adopt_end(absolute(t), &is_new_end);
      if (is_new_end) collect_anchors(box, centre);
    }
  }
}

void ModeSearch::collect_anchors(const BoxKey& box, const Vec3& centre) {
  anchors_.clear();
  for_each_neighbour(boxes_, box, [&](const BoxKey& key) {
    if (key.z < lowest_end_ || key.z > highest_end_) return;  // in the plane, two thirds of all boxes
    const auto found = ends_in_box_.find(key);
    if (found == ends_in_box_.end()) return;
    for (const int k : found->second) {
      const KnownEnd& end = ends_[as_index(k)];
      Vec3 d = end.at - centre;
      d.z() = wrapped(d.z(), options_.period);
      if (((d.cwiseAbs() - boxes_.half(kMargin)).array() > end.radius).any()) continue;
      anchors_.push_back({Float3::rounded(d), static_cast<float>(end.radius * end.radius), end.mode});
    }
  });
}

int ModeSearch::adopt_end(const Vec3& end, bool* is_new_end) {
  const int known = mode_of_end(end);
  if (known >= 0) return known;
  *is_new_end = true;
  const PolishedMode polished = polish_mode(end, options_.period, neighbours_);
  if (polished.gradient > kGradientGoal) result_.converged = false;

  int mode = -1;  // two ends of climbs with a truncated kernel may be one mode
  const BoxKey box = boxes_.key(polished.position);
  for_each_neighbour(boxes_, box, [&](const BoxKey& key) {
    const auto found = modes_in_box_.find(key);
    if (found == modes_in_box_.end()) return;
    for (const int k : found->second) {
      Vec3 d = result_.positions[as_index(k)] - polished.position;
      d.z() = wrapped(d.z(), options_.period);
      if (d.norm() < kSamePolished && (mode < 0 || k < mode)) mode = k;
    }
  });
  const bool is_new_mode = mode < 0;
  if (is_new_mode) {
    mode = static_cast<int>(result_.positions.size());
    result_.positions.push_back(polished.position);
    modes_in_box_[box].push_back(mode);
  }
  // The curvature of the log density is at most 1, and at least c at the mode. If it is at least c / 2 within r of the
  // mode, a climb from within r sqrt(c / 2) ends there. r is c over twice the third derivative, which is below 5.
  const double c = polished.curvature;
  const double radius = c > 0 ? std::clamp(0.1 * c * std::sqrt(0.5 * c), kSame, 0.05) : kSame;
  Vec3 moved = polished.position - end;
  moved.z() = wrapped(moved.z(), options_.period);
  const bool near = moved.norm() < radius;  // otherwise the climb ended on a plateau
  remember(end, near ? radius : kSame, mode);
  if (!near && is_new_mode) remember(polished.position, radius, mode);
  return mode;
}

int ModeSearch::mode_of_end(const Vec3& end) {
  int mode = -1;
  double nearest = kSame * kSame;
  for_each_neighbour(boxes_, boxes_.key(end), [&](const BoxKey& key) {
    const auto found = ends_in_box_.find(key);
    if (found == ends_in_box_.end()) return;
    for (const int k : found->second) {
      Vec3 d = ends_[as_index(k)].at - end;
      d.z() = wrapped(d.z(), options_.period);
      if (d.squaredNorm() < nearest) {
        nearest = d.squaredNorm();
        mode = ends_[as_index(k)].mode;
      }
    }
  });
  return mode;
}

void ModeSearch::remember(const Vec3& end, double radius, int mode) {
  const BoxKey box = boxes_.key(end);
  lowest_end_ = std::min(lowest_end_, box.z);
  highest_end_ = std::max(highest_end_, box.z);
  ends_in_box_[box].push_back(static_cast<int>(ends_.size()));
  ends_.push_back({end, radius, mode});
}

}  // namespace

double min_period(double cutoff) {
  return 2.0 * (cutoff + kBox + kMargin + 1e-3);
}

Modes find_modes(std::span<const Vec3> points, const ModeOptions& options, std::vector<std::vector<Vec3>>* paths) {
  SCANBENCH_ASSERT(options.cutoff > 0 && (options.period == 0 || options.period >= min_period(options.cutoff)));
  return ModeSearch(points, options, paths).run();
}

}  // namespace scanbench::merge
