// Reads the scans.csv of all cells, keeps the worst scans of each pipeline and draws them.
#include "harness/results/figures/worst_scans.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/recording.hpp"
#include "harness/io/files/csv.hpp"
#include "harness/results/document/scan_sketch.hpp"
#include "harness/results/figures/line_verdicts.hpp"
#include "harness/results/figures/scan_error.hpp"
#include "harness/runs/store/cell_files.hpp"
#include "harness/runs/store/recording_folder.hpp"
#include "harness/runs/store/run_folder.hpp"
#include "harness/runs/store/run_scenarios.hpp"
#include "harness/runs/store/run_store.hpp"
#include "harness/runs/store/stored_files.hpp"

namespace scanbench::results {
namespace {

namespace fs = std::filesystem;

bool is_worse(const WorstScan& a, const WorstScan& b) {
  const auto error = [](const WorstScan& scan) {
    return scan_error(scan.f1, scan.false_lines + scan.missed + scan.split);
  };
  return error(a) > error(b);
}

/// Inserts the scans of one cell into the list of its pipeline, which stays in order and short.
void insert_scans(const io::CsvTable& table, const runs::CellKey& key, std::size_t count,
                  std::vector<WorstScan>& worst) {
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const WorstScan scan{key,
                         static_cast<std::size_t>(std::max(0, table.index(row, "frame"))),
                         table.number(row, "f1"),
                         table.index(row, "true"),
                         table.index(row, "false"),
                         table.index(row, "missed"),
                         table.index(row, "split")};
    if (std::isnan(scan.f1)) continue;
    const auto same = std::ranges::find_if(
        worst, [&](const WorstScan& other) { return other.frame == scan.frame && other.key.scenario == key.scenario; });
    if (same != worst.end()) {
      if (!is_worse(scan, *same)) continue;
      worst.erase(same);
    }
    worst.insert(std::ranges::upper_bound(worst, scan, is_worse), scan);
    if (worst.size() > count) worst.pop_back();
  }
}

SketchLine kind_of(render::LineVerdict verdict) {
  switch (verdict) {
    case render::LineVerdict::right:
      return SketchLine::right;
    case render::LineVerdict::split:
      return SketchLine::split;
    case render::LineVerdict::false_line:
      return SketchLine::false_line;
    case render::LineVerdict::too_small:
      return SketchLine::too_small;
    default:
      return SketchLine::unjudged;
  }
}

/// A recording and the verdicts on a pipeline's lines in it.
class JudgedCell {
 public:
  JudgedCell(const runs::RunStore& store, const runs::CellKey& key, const std::vector<study::Scenario>& scenarios)
      : recording_(runs::load_recording(store.recording(key.scenario, key.seed))),
        result_(runs::load_result(store.files(key))) {
    const auto scenario = std::ranges::find(scenarios, key.scenario, &study::Scenario::name);
    if (scenario != scenarios.end()) verdicts_ = line_verdicts(recording_, result_, segment_rules(scenario->metrics));
  }

  void draw(WorstScan& scan) const {
    if (scan.frame >= recording_.observed.frames.size() || scan.frame >= result_.lines.size()) return;
    ScanSketch sketch;
    sketch.points = valid_points(recording_.observed.scan(scan.frame)).points;
    const auto& lines = result_.lines[scan.frame].lines;
    const bool judged = scan.frame < verdicts_.size();
    for (std::size_t k = 0; k < lines.size(); ++k)
      sketch.lines.push_back(
          {lines[k].segment, judged ? kind_of(verdicts_[scan.frame].lines[k]) : SketchLine::unjudged});
    scan.unjudged = static_cast<int>(std::ranges::count(sketch.lines, SketchLine::unjudged, &ScanSketch::Line::kind));
    if (judged)
      for (const Segment& missed : verdicts_[scan.frame].missed) sketch.lines.push_back({missed, SketchLine::missed});
    sketch.label =
        fmt::format("{}, scan {}: F1 {:.2f}, {} right, {} false, {} missed, {} split lines", runs::to_string(scan.key),
                    scan.frame, scan.f1, scan.found, scan.false_lines, scan.missed, scan.split);
    scan.sketch = scan_sketch(sketch);
  }

 private:
  Recording recording_;
  PipelineResult result_;
  std::vector<render::ScanVerdict> verdicts_;
};

}  // namespace

std::vector<PipelineWorst> worst_scans(const fs::path& run, const RunResults& results, std::size_t count) {
  const runs::RunStore store(run);
  std::vector<PipelineWorst> all;
  for (const auto& cell : results.cells) {
    if (!cell.ok()) continue;
    const runs::StoredFiles files = store.files(cell.key);
    if (!files.has("scans.csv")) continue;
    auto of_pipeline = std::ranges::find(all, cell.key.pipeline, &PipelineWorst::pipeline);
    if (of_pipeline == all.end()) of_pipeline = all.insert(of_pipeline, {cell.key.pipeline, {}});
    insert_scans(files.table("scans.csv", {"frame", "true", "false", "missed", "split", "f1"}), cell.key, count,
                 of_pipeline->scans);
  }
  if (all.empty()) return all;
  const std::vector<study::Scenario> scenarios = runs::load_run_scenarios(run);
  for (auto& [pipeline, scans] : all) {
    std::map<runs::CellKey, JudgedCell> cells;
    for (auto& scan : scans) {
      const auto cell = cells.try_emplace(scan.key, store, scan.key, scenarios).first;
      cell->second.draw(scan);
    }
  }
  return all;
}

}  // namespace scanbench::results
