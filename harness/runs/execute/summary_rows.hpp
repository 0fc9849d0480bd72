// The lines of summary.csv of every cell of a run, outside the memory that each child process gets a copy of.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace scanbench::runs {

class SummaryRows {
 public:
  /// Throws SystemError, as do the other functions.
  explicit SummaryRows(std::size_t cells);
  ~SummaryRows();
  SummaryRows(const SummaryRows&) = delete;
  SummaryRows& operator=(const SummaryRows&) = delete;

  /// Replaces the lines of a cell.
  void set(std::size_t cell, std::string_view lines);
  /// Bytes of a cell's lines.
  std::size_t size(std::size_t cell) const { return places_[cell].size; }
  /// The header, then the lines of all cells in order.
  std::string text() const;

 private:
  struct Place {
    std::uint64_t begin = 0;
    std::uint64_t size = 0;
  };
  int file_;  ///< without a name
  std::uint64_t end_ = 0;
  std::vector<Place> places_;
};

}  // namespace scanbench::runs
