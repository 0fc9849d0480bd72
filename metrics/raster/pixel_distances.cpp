// The two-pass distance transform of Saito and Toriwaki, "New algorithms for Euclidean distance transformation of an
// n-dimensional digitized picture with applications", Pattern Recognition 27(11), 1994: along the columns first, then
// along the rows. Two changes keep its memory to the pixels that are set and one row of the picture: the rows are
// visited from the first to the last, so that only the nearest pixels above and below of each column are kept, and the
// second pass is made for the pixels of the other set only.
#include "metrics/raster/pixel_distances.hpp"

#include <algorithm>
#include <limits>

#include "core/index.hpp"

namespace scanbench::metrics {
namespace {

constexpr std::int32_t kNone = std::numeric_limits<std::int32_t>::max() / 2;  // farther than any pixel

/// One column of the picture: the row of the nearest pixel above the visited row, or in it, and of the nearest below.
struct Column {
  std::int32_t above = -kNone;
  std::int32_t below = kNone;

  std::int64_t square(std::int32_t row) const {
    const std::int64_t distance = std::min(row - above, below - row);
    return distance * distance;
  }
};

/// The columns of a set of pixels while its rows are visited in order.
class Columns {
 public:
  explicit Columns(std::span<const Pixel> pixels) : pixels_(pixels), next_(pixels.size()) {
    const auto [low, high] = std::ranges::minmax(pixels, {}, &Pixel::x);
    first_ = low.x, last_ = high.x;
    columns_.resize(as_index(last_ - first_) + 1);
    for (std::size_t i = pixels.size(); i-- > 0;) {
      Column& column = columns_[as_index(pixels[i].x - first_)];
      next_[i] = column.below;
      column.below = pixels[i].y;
    }
  }

  void visit(std::int32_t row) {
    for (; seen_ < pixels_.size() && pixels_[seen_].y <= row; ++seen_) {
      Column& column = columns_[as_index(pixels_[seen_].x - first_)];
      column.above = pixels_[seen_].y;
      column.below = next_[seen_];
    }
  }

  /// The smallest squared distance of the pixel in column x of the visited row.
  std::int64_t nearest(std::int32_t x, std::int32_t row) const {
    std::int64_t best = std::numeric_limits<std::int64_t>::max();
    const std::int32_t start = std::clamp(x, first_, last_);
    const auto try_column = [&](std::int32_t at) {
      const std::int64_t across = at - x;
      best = std::min(best, across * across + columns_[as_index(at - first_)].square(row));
    };
    const auto is_beyond = [&](std::int64_t across) { return across * across >= best; };
    try_column(start);
    // Both directions in turn: the nearer of the next columns ends the search soonest.
    std::int32_t right = start + 1, left = start - 1;
    for (; right <= last_ && left >= first_ && !is_beyond(right - start); ++right, --left) {
      try_column(right);
      try_column(left);
    }
    for (; right <= last_ && !is_beyond(right - x); ++right) try_column(right);
    for (; left >= first_ && !is_beyond(x - left); --left) try_column(left);
    return best;
  }

 private:
  std::span<const Pixel> pixels_;
  std::int32_t first_ = 0, last_ = 0;
  std::vector<Column> columns_;     ///< from first_ to last_
  std::vector<std::int32_t> next_;  ///< per pixel the row of the next one in its column
  std::size_t seen_ = 0;
};

}  // namespace

std::vector<std::int64_t> squared_distances(std::span<const Pixel> from, std::span<const Pixel> to) {
  std::vector<std::int64_t> distances;
  if (from.empty() || to.empty()) return distances;
  distances.reserve(from.size());
  Columns columns(to);
  for (const Pixel& p : from) {
    columns.visit(p.y);
    distances.push_back(columns.nearest(p.x, p.y));
  }
  return distances;
}

}  // namespace scanbench::metrics
