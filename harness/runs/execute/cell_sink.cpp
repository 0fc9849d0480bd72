// Collects finished recordings and cells until they are flushed.
#include "harness/runs/execute/cell_sink.hpp"

#include <utility>

#include "harness/io/files/system_error.hpp"

namespace scanbench::runs {

io::StagedFolder CellSink::begin(std::size_t group, const std::filesystem::path& place) {
  if (const std::string fault = fault_of(group); !fault.empty()) throw io::SystemError(fault);
  return stage(place);
}

std::string CellSink::hashes_of(const std::filesystem::path&) const {
  return "";
}

void CellSink::put(FinishedRecording recording) {
  recordings_.push_back(std::move(recording));
}

void CellSink::put(FinishedCell cell) {
  cells_.push_back(std::move(cell));
}

std::vector<FinishedCell> CellSink::flush() {
  std::vector<FinishedCell> cells = std::exchange(cells_, {});
  if (!cells.empty() || !recordings_.empty()) keep(std::exchange(recordings_, {}), cells);
  return cells;
}

std::vector<FinishedCell> CellSink::flush_if_due() {
  return cells_.empty() || !is_due() ? std::vector<FinishedCell>() : flush();
}

std::string CellSink::fault_of(std::size_t group) const {
  const auto found = faults_.find(group);
  return found == faults_.end() ? "" : found->second;
}

}  // namespace scanbench::runs
