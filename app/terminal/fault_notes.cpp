// Groups failed cells by pipeline and message.
#include "app/terminal/fault_notes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string_view>

#include "harness/results/document/plain_text.hpp"
#include "harness/runs/store/cell_status.hpp"

namespace scanbench::app {
namespace {

/// Every run of digits becomes #: "frame 12" and "frame 7" are one fault.
std::string without_numbers(std::string_view text) {
  std::string result;
  for (const char c : text) {
    const bool digit = std::isdigit(static_cast<unsigned char>(c)) != 0;
    if (!digit)
      result += c;
    else if (result.empty() || result.back() != '#')
      result += '#';
  }
  return result;
}

std::string shortened(const std::string& text) {
  constexpr std::size_t kMost = 100;
  return text.size() <= kMost ? text : text.substr(0, kMost) + "...";
}

}  // namespace

std::string FaultNotes::note(const runs::CellResult& cell) {
  const auto& outcome = cell.record.outcome;
  const std::string status = cell.done ? std::string(to_string(outcome.status)) : "missing";
  const std::string message = results::plain_line(outcome.message);
  const std::string& subject = outcome.status == runs::CellStatus::skipped ? cell.key.scenario : cell.key.pipeline;
  const std::string key = subject + '\n' + status + '\n' + without_numbers(message);
  const auto known = std::ranges::find(faults_, key, &Fault::key);
  if (known != faults_.end()) {
    ++known->cells;
    return "";
  }
  faults_.push_back({key, fmt::format("{}: {}: {}", subject, status, shortened(message)), 1});
  return fmt::format("{}: {}: {}", runs::to_string(cell.key), status, message);
}

std::vector<std::string> FaultNotes::repeated() const {
  std::vector<std::string> lines;
  for (const Fault& fault : faults_)
    if (fault.cells > 1)
      lines.push_back(
          fmt::format("the same in {} more cell{}: {}", fault.cells - 1, fault.cells == 2 ? "" : "s", fault.text));
  return lines;
}

}  // namespace scanbench::app
