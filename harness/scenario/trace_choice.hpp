// Which rows of a trace a cell keeps.
#pragma once

#include <functional>
#include <set>
#include <string>
#include <string_view>

namespace scanbench::harness {

/// Which rows of a trace are kept.
struct TraceChoice {
  bool all = false;
  std::set<std::string, std::less<>> names = {};  ///< "slot.name"

  bool nothing() const { return !all && names.empty(); }
  /// Of `slot`, if no name is given.
  bool wants(std::string_view slot, std::string_view name = {}) const;
  std::string text() const;  ///< "all", "none" or the names: tells two choices apart
};

}  // namespace scanbench::harness
