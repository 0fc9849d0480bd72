// Packs recordings and results into JSON.
#include "harness/results/player/played_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <utility>

#include <nlohmann/json.hpp>

#include "core/recording.hpp"
#include "core/result.hpp"
#include "harness/io/files/base64.hpp"
#include "harness/io/files/csv.hpp"
#include "harness/results/figures/line_verdicts.hpp"
#include "harness/results/figures/recording_note.hpp"
#include "harness/results/figures/scan_error.hpp"
#include "harness/results/player/scan_choice.hpp"
#include "harness/runs/store/cell_files.hpp"
#include "harness/runs/store/recording_folder.hpp"
#include "harness/runs/store/run_folder.hpp"
#include "harness/runs/store/run_store.hpp"
#include "harness/runs/store/stored_files.hpp"
#include "render/palette.hpp"

namespace scanbench::results {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr double kFinestStepM = 0.001;
constexpr double kMostSteps = 32000.0;  // a coordinate is a 16-bit number

struct PlayedPipeline {
  std::string name;
  std::vector<ScanLines> lines;
  std::vector<render::ScanVerdict> verdicts;  ///< empty without truth
  std::vector<double> f1, error;              ///< per scan, error: scan_error(); NaN: undefined, empty: no scans.csv
  std::vector<double> unexplained, residual_m;
};

/// Share of the returns that support no line, and the root mean square distance of the others from their lines [m].
std::pair<double, double> explained(const Scan& scan, const ScanLines& lines) {
  int returns = 0, without = 0, with = 0;
  double squares = 0.0;
  for (int beam = 0; beam < scan.beams(); ++beam) {
    if (!scan.valid(beam)) continue;
    ++returns;
    const int line = lines.labels.empty() ? -1 : lines.labels[as_index(beam)];
    if (line < 0) {
      ++without;
      continue;
    }
    const double d = lines.lines[as_index(line)].line.signed_distance(scan.point(beam));
    squares += d * d;
    ++with;
  }
  return {returns > 0 ? static_cast<double>(without) / returns : NAN, with > 0 ? std::sqrt(squares / with) : NAN};
}

/// Fills f1 and error from scans.csv; leaves them empty without the file.
void read_scans(const runs::StoredFiles& cell, std::size_t frames, PlayedPipeline& played) {
  if (!cell.has("scans.csv")) return;
  const io::CsvTable table = cell.table("scans.csv", {"frame", "f1", "false", "missed", "split"});
  played.f1.assign(frames, NAN);
  played.error.assign(frames, NAN);
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const int frame = table.index(row, "frame");
    if (frame < 0 || as_index(frame) >= frames) table.refuse(row, fmt::format("there is no scan {}", frame));
    played.f1[as_index(frame)] = table.number(row, "f1");
    played.error[as_index(frame)] = scan_error(
        table.number(row, "f1"), table.number(row, "false") + table.number(row, "missed") + table.number(row, "split"));
  }
}

std::vector<PlayedPipeline> played_pipelines(const runs::RunStore& store, const study::Scenario& scenario,
                                             const Recording& recording) {
  const std::uint64_t seed = scenario.seeds.front();
  const std::size_t frames = recording.observed.frames.size();
  std::vector<PlayedPipeline> played;
  for (const study::PipelineSpec& pipeline : scenario.pipelines) {
    const runs::CellKey key{scenario.name, pipeline.name, seed};
    if (!store.is_ok(key)) continue;
    const runs::StoredFiles cell = store.files(key);
    PipelineResult result = runs::load_result(cell);
    if (result.lines.size() != frames) continue;
    PlayedPipeline one{.name = pipeline.name,
                       .lines = {},
                       .verdicts = line_verdicts(recording, result, segment_rules(scenario.metrics)),
                       .f1 = {},
                       .error = {},
                       .unexplained = {},
                       .residual_m = {}};
    read_scans(cell, frames, one);
    for (std::size_t f = 0; f < frames; ++f) {
      const auto [share, rms] = explained(recording.observed.scan(f), result.lines[f]);
      one.unexplained.push_back(share);
      one.residual_m.push_back(rms);
    }
    one.lines = std::move(result.lines);
    played.push_back(std::move(one));
  }
  return played;
}

/// The largest error of any pipeline: scan_error() where the truth is known, else the share of returns without a line.
std::vector<double> errors_of(const std::vector<PlayedPipeline>& pipelines, std::size_t frames) {
  std::vector<double> errors(frames, NAN);
  for (const PlayedPipeline& p : pipelines)
    for (std::size_t f = 0; f < frames; ++f)
      errors[f] = std::fmax(errors[f], p.error.empty() ? p.unexplained[f] : p.error[f]);
  return errors;
}

void append(std::string& bytes, double value_m, double step_m) {
  const auto number = static_cast<std::int16_t>(std::lround(std::clamp(value_m / step_m, -kMostSteps, kMostSteps)));
  const auto bits = static_cast<std::uint16_t>(number);
  bytes += static_cast<char>(bits & 0xFFU);
  bytes += static_cast<char>(bits >> 8U);
}

void append(std::string& bytes, const Segment& s, double step_m) {
  for (const double value : {s.a.x(), s.a.y(), s.b.x(), s.b.y()}) append(bytes, value, step_m);
}

char letter(render::LineVerdict verdict) {
  switch (verdict) {
    case render::LineVerdict::right:
      return 'r';
    case render::LineVerdict::split:
      return 's';
    case render::LineVerdict::false_line:
      return 'f';
    case render::LineVerdict::too_small:
      return 'w';
    default:
      return 'u';
  }
}

Json numbers(const std::vector<double>& values, const std::vector<std::size_t>& chosen, double unit) {
  Json list = Json::array();
  for (const std::size_t f : chosen)
    list.push_back(std::isfinite(values[f]) ? Json(std::round(values[f] / unit) * unit) : Json(nullptr));
  return list;
}

std::string hex(const render::Color& c) {
  return fmt::format("#{:02x}{:02x}{:02x}", c.r, c.g, c.b);
}

Json packed(const PlayedPipeline& p, const std::vector<std::size_t>& chosen, double step_m) {
  std::string lines, missed, verdicts;
  Json counts = Json::array(), missed_counts = Json::array();
  for (const std::size_t f : chosen) {
    counts.push_back(p.lines[f].lines.size());
    for (std::size_t k = 0; k < p.lines[f].lines.size(); ++k) {
      append(lines, p.lines[f].lines[k].segment, step_m);
      verdicts += p.verdicts.empty() ? 'u' : letter(p.verdicts[f].lines[k]);
    }
    missed_counts.push_back(p.verdicts.empty() ? 0 : p.verdicts[f].missed.size());
    if (!p.verdicts.empty())
      for (const Segment& wall : p.verdicts[f].missed) append(missed, wall, step_m);
  }
  Json json{{"name", p.name},
            {"counts", counts},
            {"lines", io::base64(lines)},
            {"verdicts", verdicts},
            {"missed_counts", missed_counts},
            {"missed", io::base64(missed)}};
  if (!p.f1.empty()) {
    json["f1"] = numbers(p.f1, chosen, 1e-4);
    json["error"] = numbers(p.error, chosen, 1e-8);
  }
  json["unexplained"] = numbers(p.unexplained, chosen, 1e-4);
  json["residual_m"] = numbers(p.residual_m, chosen, 1e-5);
  return json;
}

/// Bytes of one scan in the page: base64 of its ranges and lines, and a few numbers per pipeline.
double bytes_per_scan(const Recording& recording, const std::vector<PlayedPipeline>& pipelines) {
  double lines = 0.0;
  for (const PlayedPipeline& p : pipelines)
    for (const ScanLines& scan : p.lines) lines += static_cast<double>(scan.lines.size());
  const double frames = std::max(1.0, static_cast<double>(recording.observed.frames.size()));
  const double beams = recording.observed.sensor.geometry.beams();
  return 4.0 / 3.0 * (2.0 * beams + 2.0 * 9.0 * lines / frames) + 60.0 * static_cast<double>(pipelines.size());
}

double largest_range(const Recording& recording) {
  double largest = 0.0;
  for (const Frame& frame : recording.observed.frames)
    for (const double r : frame.ranges)
      if (std::isfinite(r)) largest = std::max(largest, r);
  return largest;
}

Json packed(const study::Scenario& scenario, const Recording& recording, const std::vector<PlayedPipeline>& pipelines,
            const std::vector<std::size_t>& chosen) {
  const ScanGeometry& geometry = recording.observed.sensor.geometry;
  const double step_m = std::max(kFinestStepM, largest_range(recording) / kMostSteps);
  std::string ranges;
  for (const std::size_t f : chosen) {
    const Scan scan = recording.observed.scan(f);
    for (int beam = 0; beam < scan.beams(); ++beam)
      append(ranges, scan.valid(beam) ? scan.ranges[as_index(beam)] : 0.0, step_m);
  }
  std::vector<std::string> names;
  names.reserve(pipelines.size());
  for (const PlayedPipeline& p : pipelines) names.push_back(p.name);
  const auto styles = render::method_styles(names);
  Json list = Json::array();
  for (std::size_t k = 0; k < pipelines.size(); ++k) {
    list.push_back(packed(pipelines[k], chosen, step_m));
    list.back()["color"] = hex(styles[k].color);
  }
  return {{"name", scenario.name},
          {"note", recording_note(scenario, std::span(scenario.seeds).first(1))},
          {"of", recording.observed.frames.size()},
          {"frames", chosen},
          {"beams", geometry.beams()},
          {"angle_min_rad", geometry.angle_min()},
          {"angle_step_rad", geometry.angle_step()},
          {"step_m", step_m},
          {"ranges", io::base64(ranges)},
          {"pipelines", std::move(list)}};
}

}  // namespace

Json played_run(const fs::path& run, const std::vector<study::Scenario>& scenarios, const PlayerLimits& limits) {
  const runs::RunStore store(run);
  Json recordings = Json::array();
  const double share =
      static_cast<double>(limits.bytes) / static_cast<double>(std::max<std::size_t>(1, scenarios.size()));
  for (const study::Scenario& scenario : scenarios) {
    const runs::StoredFiles recorded = store.recording(scenario.name, scenario.seeds.front());
    if (!recorded.exist()) continue;
    const Recording recording = runs::load_recording(recorded);
    if (recording.observed.sensor.geometry.beams() == 0 || recording.observed.frames.empty()) continue;
    const auto pipelines = played_pipelines(store, scenario, recording);
    if (pipelines.empty()) continue;
    const double fit = std::max(1.0, share / bytes_per_scan(recording, pipelines));
    const std::size_t most = std::min(limits.scans, static_cast<std::size_t>(fit));
    const auto chosen = choose_scans(errors_of(pipelines, recording.observed.frames.size()), most);
    recordings.push_back(packed(scenario, recording, pipelines, chosen));
  }
  return recordings;
}

}  // namespace scanbench::results
