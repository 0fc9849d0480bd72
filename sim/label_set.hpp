// A set of labels that finds the first repeated one, in a table with open addressing: a world may have 300 000.
#pragma once

#include <bit>
#include <cstddef>
#include <functional>
#include <string_view>
#include <vector>

namespace scanbench::sim {

class LabelSet {
 public:
  /// For at most `count` labels.
  explicit LabelSet(std::size_t count) : slots_(std::bit_ceil(2 * count + 1)) {}

  /// False if the label has been inserted before. It must not be empty, and must outlive the set.
  bool insert(std::string_view label) {
    for (std::size_t i = std::hash<std::string_view>{}(label);; ++i) {
      std::string_view& slot = slots_[i & (slots_.size() - 1)];
      if (slot == label) return false;
      if (slot.empty()) {
        slot = label;
        return true;
      }
    }
  }

 private:
  std::vector<std::string_view> slots_;  // empty: free
};

}  // namespace scanbench::sim
