// Packs recordings and results into JSON.
#include "harness/results/player/played_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <set>
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
                                             std::uint64_t seed, const Recording& recording) {
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

/// The nearest multiple of 1 / `steps`, which JSON then writes with few digits.
double rounded(double value, double steps) {
  return std::round(value * steps) / steps;
}

Json numbers(const std::vector<double>& values, const std::vector<std::size_t>& chosen, double steps) {
  Json list = Json::array();
  for (const std::size_t f : chosen)
    list.push_back(std::isfinite(values[f]) ? Json(rounded(values[f], steps)) : Json(nullptr));
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
    json["f1"] = numbers(p.f1, chosen, 1e4);
    json["error"] = numbers(p.error, chosen, 1e8);
  }
  json["unexplained"] = numbers(p.unexplained, chosen, 1e4);
  json["residual_m"] = numbers(p.residual_m, chosen, 1e5);
  return json;
}

/// Numbers with so many decimals that the page shows no difference: x, y, yaw of every chosen scan.
Json packed_poses(const std::vector<Pose2>& poses, const std::vector<std::size_t>& chosen) {
  Json list = Json::array();
  for (const std::size_t f : chosen) {
    for (const double value : {poses[f].translation().x(), poses[f].translation().y()})
      list.push_back(rounded(value, 1e3));
    list.push_back(rounded(poses[f].yaw(), 1e5));
  }
  return list;
}

/// The ends of every wall, world frame.
Json packed_walls(const std::vector<Wall>& walls) {
  Json list = Json::array();
  for (const Wall& wall : walls)
    for (const double value : {wall.segment.a.x(), wall.segment.a.y(), wall.segment.b.x(), wall.segment.b.y()})
      list.push_back(rounded(value, 1e3));
  return list;
}

bool has_true_walls(const Recording& recording) {
  return recording.truth && recording.truth->world_from_sensor.size() == recording.observed.frames.size() &&
         !recording.truth->walls.empty();
}

/// Bytes of the walls in the page.
double bytes_of_walls(const Recording& recording) {
  return has_true_walls(recording) ? 32.0 * static_cast<double>(recording.truth->walls.size()) : 0.0;
}

/// Bytes of one scan in the page: base64 of its ranges and lines, its pose, and a few numbers per pipeline.
double bytes_per_scan(const Recording& recording, const std::vector<PlayedPipeline>& pipelines) {
  double lines = 0.0;
  for (const PlayedPipeline& p : pipelines)
    for (const ScanLines& scan : p.lines) lines += static_cast<double>(scan.lines.size());
  const double frames = std::max(1.0, static_cast<double>(recording.observed.frames.size()));
  const double beams = recording.observed.sensor.geometry.beams();
  return 4.0 / 3.0 * (2.0 * beams + 2.0 * 9.0 * lines / frames) + 60.0 * static_cast<double>(pipelines.size()) + 24.0;
}

double largest_range(const Recording& recording) {
  double largest = 0.0;
  for (const Frame& frame : recording.observed.frames)
    for (const double r : frame.ranges)
      if (std::isfinite(r)) largest = std::max(largest, r);
  return largest;
}

Json packed(const study::Scenario& scenario, std::uint64_t seed, const Recording& recording,
            const std::vector<PlayedPipeline>& pipelines, const std::vector<std::size_t>& chosen) {
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
  Json json{{"name", scenario.name},
            {"seed", std::to_string(seed)},  // as text: JavaScript's numbers do not hold all seeds
            {"note", recording_note(scenario, std::span(&seed, 1))},
            {"of", recording.observed.frames.size()},
            {"frames", chosen},
            {"beams", geometry.beams()},
            {"angle_min_rad", geometry.angle_min()},
            {"angle_step_rad", geometry.angle_step()},
            {"step_m", step_m},
            {"ranges", io::base64(ranges)},
            {"pipelines", std::move(list)}};
  if (has_true_walls(recording)) {
    json["poses"] = packed_poses(recording.truth->world_from_sensor, chosen);
    json["walls"] = packed_walls(recording.truth->walls);
  }
  return json;
}

/// A recording with the lines found in it; without pipelines if there is nothing to play.
struct Played {
  Recording recording;
  std::vector<PlayedPipeline> pipelines;

  Played(const runs::RunStore& store, const study::Scenario& scenario, std::uint64_t seed) {
    const runs::StoredFiles recorded = store.recording(scenario.name, seed);
    if (!recorded.exist()) return;
    recording = runs::load_recording(recorded);
    if (recording.observed.sensor.geometry.beams() == 0 || recording.observed.frames.empty()) return;
    pipelines = played_pipelines(store, scenario, seed, recording);
  }
  /// In a page that leaves no scan out.
  double bytes() const {
    if (pipelines.empty()) return 0.0;
    const auto frames = static_cast<double>(recording.observed.frames.size());
    return bytes_of_walls(recording) + frames * bytes_per_scan(recording, pipelines);
  }
};

/// Adds those of the `wanted` scans that the recording has.
void add_scans(const std::set<std::size_t>& wanted, std::size_t frames, std::vector<std::size_t>& scans) {
  std::set<std::size_t> all(scans.begin(), scans.end());
  all.insert(wanted.begin(), wanted.lower_bound(frames));
  scans.assign(all.begin(), all.end());
}

/// True if the page can hold every scan of all seeds, each as large as the first. Reads the first ones.
bool can_hold_all_seeds(const runs::RunStore& store, const std::vector<study::Scenario>& scenarios,
                        const PlayerLimits& limits) {
  double bytes = 0.0;
  for (const study::Scenario& scenario : scenarios) {
    if (scenario.seeds.empty()) continue;
    const Played first(store, scenario, scenario.seeds.front());
    if (first.recording.observed.frames.size() > limits.scans) return false;
    bytes += first.bytes() * static_cast<double>(scenario.seeds.size());
    if (bytes > static_cast<double>(limits.bytes)) return false;
  }
  return true;
}

}  // namespace

Json played_run(const fs::path& run, const std::vector<study::Scenario>& scenarios, const PlayerLimits& limits,
                const std::optional<PlayedRecordings>& chosen) {
  const runs::RunStore store(run);
  const bool all_seeds = !chosen && can_hold_all_seeds(store, scenarios, limits);
  std::vector<std::pair<const study::Scenario*, std::uint64_t>> places;
  for (const study::Scenario& scenario : scenarios)
    for (const std::uint64_t seed : scenario.seeds)
      if (all_seeds || seed == scenario.seeds.front() || (chosen && chosen->contains({scenario.name, seed})))
        places.emplace_back(&scenario, seed);
  const double share = static_cast<double>(limits.bytes) / static_cast<double>(std::max<std::size_t>(1, places.size()));
  Json recordings = Json::array();
  for (const auto& [scenario, seed] : places) {
    const Played played(store, *scenario, seed);
    if (played.pipelines.empty()) continue;
    const std::size_t frames = played.recording.observed.frames.size();
    const double room = share - bytes_of_walls(played.recording);
    const double fit = std::max(1.0, room / bytes_per_scan(played.recording, played.pipelines));
    const std::size_t most = all_seeds ? frames : std::min(limits.scans, static_cast<std::size_t>(fit));
    auto scans = choose_scans(errors_of(played.pipelines, frames), most);
    if (chosen && chosen->contains({scenario->name, seed}))
      add_scans(chosen->at({scenario->name, seed}), frames, scans);
    recordings.push_back(packed(*scenario, seed, played.recording, played.pipelines, scans));
  }
  return recordings;
}

}  // namespace scanbench::results
