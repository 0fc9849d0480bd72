// Messages about cells that failed: one for each fault, not one for each cell.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "harness/runs/execute/run_options.hpp"

namespace scanbench::app {

/// Collects the cells of a run that are not ok. Cells of one pipeline with the same status and message, numbers in it
/// aside, have the same fault; so have all cells of a scenario that are skipped for the same reason.
class FaultNotes {
 public:
  /// The note about this cell if it is the first with its fault, else empty.
  std::string note(const runs::CellResult& cell);
  /// A line for each fault that more than one cell has: "iepf: failed: ...: 39 more cells".
  std::vector<std::string> repeated() const;

 private:
  struct Fault {
    std::string key;
    std::string text;
    std::size_t cells = 0;
  };
  std::vector<Fault> faults_;
};

}  // namespace scanbench::app
