// Trace row of one round of an alignment.
#pragma once

#include <string_view>
#include <tuple>

#include "core/trace/trace_schema.hpp"

namespace scanbench::align {

/// One round of pairing the points of all scans and solving for all poses together.
struct RoundRow {
  static constexpr std::string_view kName = "round";
  int round = 0;
  double gate_m = 0.0;
  int pairs = 0;
  double rms_m = 0.0;
  double largest_shift_m = 0.0;
  double largest_turn_rad = 0.0;
  static constexpr auto columns() {
    using R = RoundRow;
    return std::tuple{column("round", &R::round),
                      column("gate_m", &R::gate_m),
                      column("pairs", &R::pairs),
                      column("rms_m", &R::rms_m),
                      column("largest_shift_m", &R::largest_shift_m),
                      column("largest_turn_rad", &R::largest_turn_rad)};
  }
};

}  // namespace scanbench::align
