// Stopwatch and journal.
#include "harness/traces.hpp"

#include <algorithm>

#include <time.h>

#include "core/number_text.hpp"
#include "harness/csv.hpp"

namespace scanbench::harness {

double thread_cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

void Stopwatch::start() {
  parts_.clear();
  current_ = 0;
  since_ = thread_cpu_seconds();
}

void Stopwatch::close_current(double now) {
  parts_[current_].seconds += now - since_;
  since_ = now;
}

void Stopwatch::stage(std::string_view name) {
  if (!parts_.empty()) close_current(thread_cpu_seconds());
  const auto found = std::ranges::find(parts_, name, &Part::name);
  current_ = static_cast<std::size_t>(found - parts_.begin());
  if (found == parts_.end()) parts_.push_back({std::string(name)});
}

void Stopwatch::stop(std::string_view whole, std::string_view prefix, int frame, std::vector<StageTime>& times) {
  const double now = thread_cpu_seconds();
  if (parts_.empty())
    parts_.push_back({std::string(whole)});
  else
    for (auto& part : parts_) part.name = std::string(prefix) + part.name;
  close_current(now);
  for (const auto& part : parts_) times.push_back({part.name, frame, part.seconds});
}

Journal::Journal() : text_("slot,frame,stage,name,values\n") {}

void Journal::begin(std::string_view slot, int frame) {
  slot_ = slot;
  frame_ = frame;
  stage_.clear();
}

void Journal::write(std::string_view name, std::span<const double> values) {
  text_ += csv_field(slot_) + "," + std::to_string(frame_) + "," + csv_field(stage_) + "," + csv_field(name) + ",";
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i > 0) text_.push_back(' ');
    text_ += number_text(values[i]);
  }
  text_.push_back('\n');
}

}  // namespace scanbench::harness
