// Wraps Boost's R-tree: of walls a grid would hold long ones in hundreds of cells, or short ones by hundreds in a cell.
#include "algorithms/map/parts/segment_index.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

// The library itself includes a header that it calls deprecated.
#define BOOST_ALLOW_DEPRECATED_HEADERS
#include <boost/geometry.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>

namespace scanbench::mapping {
namespace {

namespace bg = boost::geometry;
using Point = bg::model::point<double, 2, bg::cs::cartesian>;
using Box = bg::model::box<Point>;
using Entry = std::pair<Box, std::size_t>;
constexpr std::size_t kNodeSize = 16;

Box box_of(const Segment& s, double margin) {
  const Vec2 low = s.a.cwiseMin(s.b), high = s.a.cwiseMax(s.b);
  return {Point(low.x() - margin, low.y() - margin), Point(high.x() + margin, high.y() + margin)};
}

}  // namespace

struct SegmentIndex::Tree {
  bg::index::rtree<Entry, bg::index::quadratic<kNodeSize>> entries;
};

SegmentIndex::SegmentIndex() : tree_(std::make_unique<Tree>()) {}
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
  std::vector<Entry> hits;
  for (const Segment& s : segments) {
    hits.clear();
    tree_->entries.query(bg::index::intersects(box_of(s, reach_m)), std::back_inserter(hits));
    for (const Entry& hit : hits) found.push_back(hit.second);
  }
  std::ranges::sort(found);
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace scanbench::mapping
