// The journal of an algorithm: what it thought on the way. Costs nothing unless somebody listens.
#pragma once

#include <initializer_list>
#include <span>
#include <string_view>

#include "core/geometry.hpp"

namespace scanbench {

/// Base class and null object: all calls do nothing. A recorder overrides write(), a stopwatch overrides stage(). Code
/// that must prepare what it writes asks recording() first.
class Trace {
 public:
  virtual ~Trace() = default;
  virtual bool recording() const { return false; }
  /// A stage of the work begins ("pre", "segment", "fit", ...); the one before it ends.
  virtual void stage(std::string_view) {}
  /// A named row of numbers; rows of one name have one length.
  virtual void write(std::string_view, std::span<const double>) {}

  void row(std::string_view name, std::initializer_list<double> values) {
    write(name, {values.begin(), values.size()});
  }
  void scalar(std::string_view name, double value) { row(name, {value}); }
  void point(std::string_view name, const Vec2& p) { row(name, {p.x(), p.y()}); }
  void segment(std::string_view name, const Segment& s) { row(name, {s.a.x(), s.a.y(), s.b.x(), s.b.y()}); }
};

}  // namespace scanbench
