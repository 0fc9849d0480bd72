// Selects the rows of a trace that a cell keeps.
#pragma once

#include <functional>
#include <set>
#include <string>
#include <string_view>

namespace scanbench::study {

struct TraceChoice {
  bool all = false;
  std::set<std::string, std::less<>> names = {};  ///< "slot.name"

  bool nothing() const { return !all && names.empty(); }
  /// True if rows of this name in `slot` are kept; without a name, if any row of `slot` is.
  bool wants(std::string_view slot, std::string_view name = {}) const;
  std::string text() const;  ///< "all", "none" or the names; different for different choices
};

}  // namespace scanbench::study
