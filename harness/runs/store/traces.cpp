// Writes and reads traces as CSV.
#include "harness/runs/store/traces.hpp"

#include <algorithm>
#include <charconv>

#include "core/number_text.hpp"
#include "harness/io/files/csv.hpp"
#include "harness/io/files/text_file.hpp"

namespace scanbench::runs {

Journal::Journal(study::TraceChoice choice) : choice_(std::move(choice)), text_("slot,frame,stage,name,values\n") {}

Trace Journal::begin(std::string_view slot, int frame) {
  slot_ = slot;
  frame_ = frame;
  stage_.clear();
  if (!choice_.wants(slot_)) return {};
  return Trace({.stage = [this](Stage begun) { stage_ = to_string(begun); },
                .row = [this](const TraceSchema& schema, std::span<const double> v) { write(schema.name, v); }});
}

void Journal::write(std::string_view name, std::span<const double> values) {
  if (!choice_.wants(slot_, name)) return;
  text_ += io::csv_field(slot_) + "," + std::to_string(frame_) + "," + io::csv_field(stage_) + "," +
           io::csv_field(name) + ",";
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i > 0) text_.push_back(' ');
    text_ += number_text(values[i]);
  }
  text_.push_back('\n');
}

TraceRows load_trace(const StoredFiles& cell, const study::TraceChoice& choice) {
  TraceRows rows;
  std::vector<std::string_view> words;
  if (choice.nothing() || !cell.has(kTraceFile)) return rows;
  const io::CsvTable csv = cell.table(kTraceFile, {"slot", "frame", "stage", "name", "values"});
  for (std::size_t r = 0; r < csv.rows(); ++r) {
    const std::string slot = csv.text(r, "slot"), name = csv.text(r, "name");
    if (!choice.wants(slot, name)) continue;
    TraceRow row{csv.index(r, "frame"), {}};
    io::split_words(csv.field(r, "values"), words);
    for (const std::string_view word : words) {
      const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), row.values.emplace_back());
      if (error != std::errc() || end != word.data() + word.size())
        csv.refuse(r, io::quoted_excerpt(word) + " is not a number");
    }
    rows[slot + "." + name].push_back(std::move(row));
  }
  return rows;
}

}  // namespace scanbench::runs
