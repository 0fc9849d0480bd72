// Wraps Boost's R-tree: of walls a grid would hold long ones in hundreds of cells, or short ones by hundreds in a cell.
#include "core/geometry/segment_index.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

// The library itself includes a header that it calls deprecated.
#define BOOST_ALLOW_DEPRECATED_HEADERS
#include <boost/geometry.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>

namespace scanbench {
namespace {

namespace bg = boost::geometry;
using TreePoint = bg::model::point<double, 2, bg::cs::cartesian>;
using TreeBox = bg::model::box<TreePoint>;
using TreeEntry = std::pair<TreeBox, std::size_t>;
constexpr std::size_t kNodeSize = 16;

TreeBox box_of(const Segment& s, double margin) {
  const Vec2 low = s.a.cwiseMin(s.b), high = s.a.cwiseMax(s.b);
  return {TreePoint(low.x() - margin, low.y() - margin), TreePoint(high.x() + margin, high.y() + margin)};
}

}  // namespace

struct SegmentIndex::Tree {
  bg::index::rtree<TreeEntry, bg::index::quadratic<kNodeSize>> entries;
};

SegmentIndex::SegmentIndex() : tree_(std::make_unique<Tree>()) {}

SegmentIndex::SegmentIndex(std::span<const Segment> segments, std::span<const double> margins_m) {
  std::vector<TreeEntry> entries;
  entries.reserve(segments.size());
  for (std::size_t i = 0; i < segments.size(); ++i) entries.emplace_back(box_of(segments[i], margins_m[i]), i);
  tree_ = std::make_unique<Tree>(Tree{decltype(Tree::entries)(entries)});  // packed, which is faster than insertion
}

SegmentIndex::~SegmentIndex() = default;
SegmentIndex::SegmentIndex(SegmentIndex&&) noexcept = default;
SegmentIndex& SegmentIndex::operator=(SegmentIndex&&) noexcept = default;

void SegmentIndex::insert(std::size_t number, const Segment& segment) {
  tree_->entries.insert({box_of(segment, 0.0), number});
}

void SegmentIndex::erase(std::size_t number, const Segment& segment) {
  tree_->entries.remove({box_of(segment, 0.0), number});
}

std::vector<std::size_t> SegmentIndex::near(std::span<const Segment> segments, double reach_m) const {
  std::vector<std::size_t> found;
  std::vector<TreeEntry> hits;
  for (const Segment& s : segments) {
    hits.clear();
    tree_->entries.query(bg::index::intersects(box_of(s, reach_m)), std::back_inserter(hits));
    for (const TreeEntry& hit : hits) found.push_back(hit.second);
  }
  std::ranges::sort(found);
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace scanbench
