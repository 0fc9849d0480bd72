// Non-blurring Gaussian mean shift of a point set (Lakaemper 2009, section III, eq. 1).
//
// Climbs are independent of each other and run box by box. All climbs in a box share one list of candidates. A climb
// that leaves its box continues in the next round, in which climbs are sorted by box. The kernel is cut off during
// climbs. One end per mode is polished in double, with a kernel cut off at 6.5.
#include "algorithms/merge/mean_shift/modes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numeric>
#include <unordered_map>
#include <utility>

#include "algorithms/merge/mean_shift/climb.hpp"
#include "algorithms/merge/mean_shift/mode_polish.hpp"
#include "core/error.hpp"
#include "core/index.hpp"

namespace scanbench::merge {
namespace {

constexpr double kModeBox = 1.0;     // side of a box
constexpr double kHysteresis = 0.1;  // distance by which a climb may leave its box before it changes to the next
constexpr double kMargin =
    kHysteresis + kLongestFastStep + 1e-3;  // distance from the box up to which candidates are complete
constexpr double kSame = 2e-3;              // ends of climbs this close are one mode: they are converged to 1e-5
constexpr double kSamePolished = 1e-5;
constexpr double kModeGradientGoal = 1e-6;

/// Coordinates are below 1e9, so that 32 bits hold the number of a box.
struct BoxKey {
  std::int32_t x;
  std::int32_t y;
  std::int32_t z;
  auto operator<=>(const BoxKey&) const = default;
};

/// Boxes of side 1 in x and y, and in z of a side that divides the period.
class Boxes {
 public:
  explicit Boxes(double period) {
    if (period > 0) {
      count_z_ = std::max<std::int32_t>(1, static_cast<std::int32_t>(period / kModeBox));
      side_z_ = period / static_cast<double>(count_z_);
    }
  }
  BoxKey key(const Vec3& p) const {
    return {floor_of(p.x() / kModeBox), floor_of(p.y() / kModeBox), wrap_z(floor_of(p.z() / side_z_))};
  }
  Vec3 centre(const BoxKey& k) const {
    return {(static_cast<double>(k.x) + 0.5) * kModeBox, (static_cast<double>(k.y) + 0.5) * kModeBox,
            (static_cast<double>(k.z) + 0.5) * side_z_};
  }
  /// Half sides, grown by a margin.
  Vec3 half(double margin) const { return {0.5 * kModeBox + margin, 0.5 * kModeBox + margin, 0.5 * side_z_ + margin}; }
  std::int32_t wrap_z(std::int32_t z) const { return count_z_ > 0 ? ((z % count_z_) + count_z_) % count_z_ : z; }

 private:
  static std::int32_t floor_of(double v) { return static_cast<std::int32_t>(std::floor(v)); }

  std::int32_t count_z_ = 0;
  double side_z_ = kModeBox;
};

/// A point and the box that it is in. Of millions of points, this is what a search keeps beside them.
struct Start {
  BoxKey box;
  std::uint32_t point;
  auto operator<=>(const Start&) const = default;
};

struct PendingClimb {
  Start start;
  int steps = 0;
  Vec3 at;
};

/// Numbers (of ends, or of modes) by the box that they are in. A column has all boxes of one x and y.
class NumbersInBoxes {
 public:
  void add(const BoxKey& box, int number) {
    auto& column = columns_[key_of(box.x, box.y)];
    const auto behind = std::ranges::upper_bound(column, box.z, {}, &Entry::z);
    column.insert(behind, {box.z, number});
  }
  /// Calls visit(number) for all in the box and its neighbours, by box, and within a box in the order in which they
  /// were added.
  template <class Visit>
  void for_each_near(const Boxes& boxes, const BoxKey& box, Visit&& visit) const {
    const std::array<std::int32_t, 3> zs{boxes.wrap_z(box.z - 1), box.z, boxes.wrap_z(box.z + 1)};
    for (std::int32_t x = box.x - 1; x <= box.x + 1; ++x)
      for (std::int32_t y = box.y - 1; y <= box.y + 1; ++y) {
        const auto column = columns_.find(key_of(x, y));
        if (column == columns_.end()) continue;
        for (const Entry& entry : column->second)
          if (entry.z == zs[0] || entry.z == zs[1] || entry.z == zs[2]) visit(entry.number);
      }
  }

 private:
  struct Entry {
    std::int32_t z;
    int number;
  };
  struct Hash {
    std::size_t operator()(std::uint64_t key) const {
      key *= 0x9E3779B97F4A7C15ULL;
      return key ^ (key >> 32);
    }
  };
  static std::uint64_t key_of(std::int32_t x, std::int32_t y) {
    return static_cast<std::uint64_t>(static_cast<std::uint32_t>(x)) << 32 | static_cast<std::uint32_t>(y);
  }
  std::unordered_map<std::uint64_t, std::vector<Entry>, Hash> columns_;  // entries by z, equal ones as they were added
};

/// Calls visit(span) for each run of neighbours in the list with the same box.
template <class Item, class BoxOf, class Visit>
void for_each_box(const std::vector<Item>& sorted, BoxOf box_of, Visit&& visit) {
  for (std::size_t begin = 0; begin < sorted.size();) {
    std::size_t end = begin + 1;
    while (end < sorted.size() && std::invoke(box_of, sorted[end]) == std::invoke(box_of, sorted[begin])) ++end;
    visit(std::span(sorted).subspan(begin, end - begin));
    begin = end;
  }
}

class ModeSearch {
 public:
  ModeSearch(std::span<const Vec3> points, const ModeOptions& options, std::vector<std::vector<Vec3>>* paths)
      : points_(points),
        options_(options),
        paths_(paths),
        grid_(points, kModeBox, options.period),
        boxes_(options.period) {
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

  std::vector<Start> starts_of_climbs(std::vector<std::pair<std::uint32_t, std::uint32_t>>& repeated);
  void process_box(std::span<const PendingClimb> climbs, std::vector<PendingClimb>& next);
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
  NumbersInBoxes ends_in_boxes_;
  NumbersInBoxes modes_in_boxes_;
  Modes result_;
};

Modes ModeSearch::run() {
  const std::size_t n = points_.size();
  SCANBENCH_ASSERT(n <= std::numeric_limits<std::uint32_t>::max());
  result_.mode_of.assign(n, -1);
  if (paths_ != nullptr) paths_->assign(n, {});

  // Equal points climb once and have the result of the first of them.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> repeated;  // a point, and the first that is equal to it
  std::vector<Start> starts = starts_of_climbs(repeated);
  std::vector<PendingClimb> pending, next;
  for_each_box(starts, &Start::box, [&](std::span<const Start> box) {
    pending.clear();
    for (const Start& start : box) pending.push_back({start, 0, points_[start.point]});
    process_box(pending, next);
  });
  std::vector<Start>().swap(starts);
  while (!next.empty()) {
    pending.swap(next);
    next.clear();
    std::ranges::sort(pending, {}, &PendingClimb::start);
    for_each_box(
        pending, [](const PendingClimb& climb) { return climb.start.box; },
        [&](std::span<const PendingClimb> box) { process_box(box, next); });
  }

  if (paths_ != nullptr)
    for (std::size_t i = 0; i < n; ++i)
      if (result_.mode_of[i] >= 0) (*paths_)[i].push_back(result_.positions[as_index(result_.mode_of[i])]);
  for (const auto& [point, first] : repeated) {
    result_.mode_of[point] = result_.mode_of[first];
    if (paths_ != nullptr) (*paths_)[point] = (*paths_)[first];
  }
  return std::move(result_);
}

std::vector<Start> ModeSearch::starts_of_climbs(std::vector<std::pair<std::uint32_t, std::uint32_t>>& repeated) {
  const auto n = static_cast<std::uint32_t>(points_.size());
  std::vector<std::uint32_t> order(n);
  std::iota(order.begin(), order.end(), 0U);
  const auto key_of = [&](std::uint32_t i) { return std::array{points_[i].x(), points_[i].y(), points_[i].z()}; };
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t a, std::uint32_t b) { return std::pair(key_of(a), a) < std::pair(key_of(b), b); });
  std::vector<Start> starts;
  starts.reserve(n);
  for (std::uint32_t k = 0, first = 0; k < n; ++k) {
    const std::uint32_t i = order[k];
    if (paths_ != nullptr) (*paths_)[i].push_back(points_[i]);
    if (k > 0 && points_[i] == points_[first]) {
      repeated.emplace_back(i, first);
    } else {
      first = i;
      starts.push_back({boxes_.key(points_[i]), i});
    }
  }
  std::ranges::sort(starts);
  return starts;
}

void ModeSearch::process_box(std::span<const PendingClimb> climbs, std::vector<PendingClimb>& next) {
  const BoxKey box = climbs.front().start.box;
  const Vec3 centre = boxes_.centre(box);
  candidates_.clear();
  candidates_.add_near(grid_, centre, boxes_.half(kMargin), options_.cutoff + 1e-3);
  candidates_.seal();
  collect_anchors(box, centre);

  for (const PendingClimb& pending : climbs) {
    const std::uint32_t point = pending.start.point;
    int steps = pending.steps;
    Vec3 from_centre = pending.at - centre;
    from_centre.z() = wrapped(from_centre.z(), options_.period);
    Float3 t = Float3::rounded(from_centre);
    int captured_by = -1;
    path_.clear();
    const ClimbEnd end =
        climb(candidates_, anchors_, rules_, t, steps, captured_by, paths_ != nullptr ? &path_ : nullptr);
    const auto absolute = [&](const Float3& p) {
      Vec3 v = centre + Vec3(p.x, p.y, p.z);
      v.z() = reduced(v.z(), options_.period);
      return v;
    };
    if (paths_ != nullptr)
      for (const Float3& p : path_) (*paths_)[point].push_back(absolute(p));
    int& mode = result_.mode_of[point];
    if (end == ClimbEnd::captured) {
      mode = anchors_[as_index(captured_by)].mode;
    } else if (end == ClimbEnd::left_box) {
      const Vec3 at = absolute(t);
      next.push_back({{boxes_.key(at), point}, steps, at});
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
  ends_in_boxes_.for_each_near(boxes_, box, [&](int k) {
    const KnownEnd& end = ends_[as_index(k)];
    Vec3 d = end.at - centre;
    d.z() = wrapped(d.z(), options_.period);
    if (((d.cwiseAbs() - boxes_.half(kMargin)).array() > end.radius).any()) return;
    anchors_.push_back({Float3::rounded(d), static_cast<float>(end.radius * end.radius), end.mode});
  });
}

int ModeSearch::adopt_end(const Vec3& end, bool* is_new_end) {
  const int known = mode_of_end(end);
  if (known >= 0) return known;
  *is_new_end = true;
  const PolishedMode polished = polish_mode(end, options_.period, neighbours_);
  if (polished.gradient > kModeGradientGoal) result_.converged = false;

  int mode = -1;  // two ends of climbs with a truncated kernel may be one mode
  const BoxKey box = boxes_.key(polished.position);
  modes_in_boxes_.for_each_near(boxes_, box, [&](int k) {
    Vec3 d = result_.positions[as_index(k)] - polished.position;
    d.z() = wrapped(d.z(), options_.period);
    if (d.norm() < kSamePolished && (mode < 0 || k < mode)) mode = k;
  });
  const bool is_new_mode = mode < 0;
  if (is_new_mode) {
    mode = static_cast<int>(result_.positions.size());
    result_.positions.push_back(polished.position);
    modes_in_boxes_.add(box, mode);
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
  ends_in_boxes_.for_each_near(boxes_, boxes_.key(end), [&](int k) {
    Vec3 d = ends_[as_index(k)].at - end;
    d.z() = wrapped(d.z(), options_.period);
    if (d.squaredNorm() < nearest) {
      nearest = d.squaredNorm();
      mode = ends_[as_index(k)].mode;
    }
  });
  return mode;
}

void ModeSearch::remember(const Vec3& end, double radius, int mode) {
  ends_in_boxes_.add(boxes_.key(end), static_cast<int>(ends_.size()));
  ends_.push_back({end, radius, mode});
}

}  // namespace

double min_period(double cutoff) {
  return 2.0 * (cutoff + kModeBox + kMargin + 1e-3);
}

Modes find_modes(std::span<const Vec3> points, const ModeOptions& options, std::vector<std::vector<Vec3>>* paths) {
  SCANBENCH_ASSERT(options.cutoff > 0 && (options.period == 0 || options.period >= min_period(options.cutoff)));
  return ModeSearch(points, options, paths).run();
}

}  // namespace scanbench::merge
