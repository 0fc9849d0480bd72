// The journal of an algorithm: the stages of its work and the rows that it writes down on the way. Both cost next to
// nothing unless somebody listens.
#pragma once

#include <functional>
#include <span>
#include <utility>

#include "core/stage.hpp"
#include "core/trace_schema.hpp"

namespace scanbench {

/// Passes stages and rows to whoever listens; a Trace made without arguments passes them to nobody.
class Trace {
 public:
  struct Listener {
    std::function<void(Stage)> stage = {};                                      ///< may be empty
    std::function<void(const TraceSchema&, std::span<const double>)> row = {};  ///< may be empty
  };

  Trace() = default;
  explicit Trace(Listener listener) : listener_(std::move(listener)) {}

  /// Does anybody read the rows? Code that must prepare what it writes asks first.
  bool recording() const { return static_cast<bool>(listener_.row); }
  /// A stage of the work begins; the stage before it ends.
  void stage(Stage begun) {
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
