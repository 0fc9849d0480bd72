// Stopwatch and journal.
#include "harness/traces.hpp"

#include <algorithm>
#include <charconv>

#include <time.h>

#include "core/number_text.hpp"
#include "harness/atomic_file.hpp"
#include "harness/csv.hpp"
#include "harness/text_file.hpp"

namespace scanbench::harness {

double thread_cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

Trace Stopwatch::start() {
  parts_.clear();
  current_ = 0;
  since_ = thread_cpu_seconds();
  return Trace({.stage = [this](Stage begun) { stage(begun); }});
}

void Stopwatch::close_current(double now) {
  parts_[current_].seconds += now - since_;
  since_ = now;
}

void Stopwatch::stage(Stage begun) {
  if (!parts_.empty()) close_current(thread_cpu_seconds());
  const auto found = std::ranges::find(parts_, begun, &Part::stage);
  current_ = static_cast<std::size_t>(found - parts_.begin());
  if (found == parts_.end()) parts_.push_back({begun});
}

void Stopwatch::stop(std::string_view slot, int frame, std::vector<StageTime>& times) {
  const double now = thread_cpu_seconds();
  if (parts_.empty()) parts_.push_back({});
  close_current(now);
  for (const auto& part : parts_) times.push_back({std::string(slot), part.stage, frame, part.seconds});
}

bool TraceChoice::wants(std::string_view slot, std::string_view name) const {
  if (all) return true;
  const std::string prefix = std::string(slot) + ".";
  if (!name.empty()) return names.contains(prefix + std::string(name));
  const auto first = names.lower_bound(prefix);
  return first != names.end() && first->starts_with(prefix);
}

std::string TraceChoice::text() const {
  if (all) return "all";
  std::string joined;
  for (const auto& name : names) joined += (joined.empty() ? "" : " ") + name;
  return joined.empty() ? "none" : joined;
}

Journal::Journal(TraceChoice choice) : choice_(std::move(choice)), text_("slot,frame,stage,name,values\n") {}

Trace Journal::begin(std::string_view slot, int frame) {
  slot_ = slot;
  frame_ = frame;
  stage_.clear();
  if (!choice_.wants(slot_)) return Trace();
  return Trace({.stage = [this](Stage begun) { stage_ = to_string(begun); },
                .row = [this](const TraceSchema& schema, std::span<const double> v) { write(schema.name, v); }});
}

void Journal::write(std::string_view name, std::span<const double> values) {
  if (!choice_.wants(slot_, name)) return;
  text_ += csv_field(slot_) + "," + std::to_string(frame_) + "," + csv_field(stage_) + "," + csv_field(name) + ",";
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i > 0) text_.push_back(' ');
    text_ += number_text(values[i]);
  }
  text_.push_back('\n');
}

TraceRows load_trace(const std::filesystem::path& cell, const TraceChoice& choice) {
  const auto file = cell / "trace.csv";
  TraceRows rows;
  std::vector<std::string_view> words;
  if (choice.nothing() || !std::filesystem::exists(file)) return rows;
  const CsvTable csv(read_file(file), file, {"slot", "frame", "stage", "name", "values"});
  for (std::size_t r = 0; r < csv.rows(); ++r) {
    const std::string &slot = csv.text(r, "slot"), &name = csv.text(r, "name");
    if (!choice.wants(slot, name)) continue;
    TraceRow row{csv.index(r, "frame"), {}};
    split_words(csv.text(r, "values"), words);
    for (const std::string_view word : words) {
      const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), row.values.emplace_back());
      if (error != std::errc() || end != word.data() + word.size())
        csv.refuse(r, quoted_excerpt(word) + " is not a number");
    }
    rows[slot + "." + name].push_back(std::move(row));
  }
  return rows;
}

}  // namespace scanbench::harness
