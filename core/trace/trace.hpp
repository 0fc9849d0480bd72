// The trace of an algorithm: the stages of its work and rows of intermediate results. Without a listener both cost
// almost nothing.
#pragma once

#include <functional>
#include <span>
#include <utility>

#include "core/trace/stage.hpp"
#include "core/trace/trace_schema.hpp"

namespace scanbench {

/// Passes stages and rows to a listener, if it has one.
class Trace {
 public:
  struct Listener {
    std::function<void(Stage)> stage = {};                                      ///< may be empty
    std::function<void(const TraceSchema&, std::span<const double>)> row = {};  ///< may be empty
  };

  Trace() = default;
  explicit Trace(Listener listener) : listener_(std::move(listener)) {}

  /// True if a listener reads rows. Code that must prepare its rows checks this first.
  bool recording() const { return static_cast<bool>(listener_.row); }
  /// A stage of the work begins; the stage before it ends.
  void stage(Stage begun) const {
    if (listener_.stage) listener_.stage(begun);
  }
  template <TraceRowType Row>
  void row(const Row& row) {
    if (listener_.row) listener_.row(schema_of<Row>(), values_of(row));
  }

 private:
  Listener listener_;
};

}  // namespace scanbench
