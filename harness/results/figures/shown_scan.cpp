// Chooses the cell and the scan, and draws it as the figure scan_overlay does.
#include "harness/results/figures/shown_scan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <vector>

#include "core/error.hpp"
#include "core/names.hpp"
#include "core/registry.hpp"
#include "harness/io/files/atomic_file.hpp"
#include "harness/io/files/csv.hpp"
#include "harness/io/files/text_file.hpp"
#include "harness/results/figures/line_verdicts.hpp"
#include "harness/results/figures/scan_error.hpp"
#include "harness/runs/store/cell_files.hpp"
#include "harness/runs/store/cell_status.hpp"
#include "harness/runs/store/recording_folder.hpp"
#include "harness/runs/store/run_folder.hpp"
#include "harness/runs/store/run_scenarios.hpp"
#include "harness/runs/store/run_store.hpp"
#include "harness/runs/store/stored_files.hpp"
#include "render/backends/cairo.hpp"
#include "render/backends/gl.hpp"
#include "render/figure.hpp"

namespace scanbench::results {
namespace fs = std::filesystem;
namespace {

/// The element of this name; the only element if the name is empty.
template <class T>
const T& choose(const std::vector<T>& all, const std::string& name, const std::string& option, const std::string& of) {
  std::vector<std::string> known;
  for (const T& one : all) known.push_back(one.name);
  const auto found = std::ranges::find(all, name, &T::name);
  if (found != all.end()) return *found;
  if (name.empty() && all.size() == 1) return all.front();
  if (name.empty())
    throw ConfigError(
        fmt::format("{} has {} {}s; --{} must name one of them: {}", of, all.size(), option, option, join(known)));
  throw ConfigError(fmt::format("{} has no {} '{}'{}", of, option, name, known_names(name, known)));
}

/// The rows of a cell's scans.csv.
class ScanRows {
 public:
  explicit ScanRows(const runs::StoredFiles& cell) : file_(cell.path("scans.csv")) {
    if (cell.has("scans.csv"))
      table_ = cell.table("scans.csv", {"frame", "true", "false", "missed", "split", "f1", "residual_m"});
  }

  /// That with the largest scan_error(); of several the first.
  std::size_t worst_frame() const {
    if (!table_)
      throw ConfigError(file_.string() + ": no such file, so the worst scan is not known; the metric family " +
                        "`segments` writes it for recordings with a truth; or give the number of a scan: --frame N");
    std::optional<std::size_t> worst;
    for (std::size_t row = 0; row < table_->rows(); ++row) {
      if (std::isnan(error(row))) continue;
      if (!worst || error(row) > error(*worst)) worst = row;
    }
    if (!worst) throw ConfigError(file_.string() + ": no scan has an F1: none shows a true line, and none was found");
    return static_cast<std::size_t>(std::max(0, table_->index(*worst, "frame")));
  }

  /// "8 right, 1 false, 0 missed, 2 split".
  std::string counts(std::size_t frame) const {
    const auto row = row_of(frame);
    if (!row) return "";
    return fmt::format("{} right, {} false, {} missed, {} split", table_->text(*row, "true"),
                       table_->text(*row, "false"), table_->text(*row, "missed"), table_->text(*row, "split"));
  }

  std::string text(std::size_t frame) const {
    const auto row = row_of(frame);
    if (!row) return "";
    return counts(frame) +
           fmt::format("; F1 {}, residual {}", rounded(*row, "f1", ""), rounded(*row, "residual_m", " m"));
  }

 private:
  std::optional<std::size_t> row_of(std::size_t frame) const {
    for (std::size_t row = 0; table_ && row < table_->rows(); ++row)
      if (table_->text(row, "frame") == std::to_string(frame)) return row;
    return std::nullopt;
  }
  double error(std::size_t row) const {
    return scan_error(table_->number(row, "f1"),
                      table_->number(row, "false") + table_->number(row, "missed") + table_->number(row, "split"));
  }
  std::string rounded(std::size_t row, const char* column, const char* unit) const {
    const double value = table_->number(row, column);
    return std::isnan(value) ? "undefined" : fmt::format("{:.3g}{}", value, unit);
  }

  fs::path file_;
  std::optional<io::CsvTable> table_;
};

std::size_t frame_number(const std::string& text, std::size_t frames) {
  std::size_t frame = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), frame);
  if (frames == 0) throw ConfigError("the recording has no scans");
  if (text.empty() || error != std::errc() || stop != text.data() + text.size() || frame >= frames)
    throw ConfigError(
        fmt::format("--frame: there is no scan {}; allowed: 0 to {}, or worst", io::quoted_excerpt(text), frames - 1));
  return frame;
}

/// A cell of a run that ended well.
struct ChosenCell {
  ChosenCell(const fs::path& run, const ScanChoice& choice) {
    const std::vector<study::Scenario> scenarios = runs::load_run_scenarios(run);
    const study::Scenario& scenario = choose(scenarios, choice.scenario, "scenario", run.string());
    const study::PipelineSpec& pipeline = choose(scenario.pipelines, choice.pipeline, "pipeline", scenario.name);
    key = {scenario.name, pipeline.name, choice.seed.value_or(scenario.seeds.front())};
    const runs::RunStore store(run);
    const auto record = store.record(key);
    if (!record) throw ConfigError(run.string() + ": the cell " + runs::to_string(key) + " is missing");
    if (const runs::CellStatus status = record->outcome.status; status != runs::CellStatus::ok)
      throw ConfigError(run.string() + ": the cell " + runs::to_string(key) + " has no lines: it is " +
                        std::string(runs::to_string(status)));
    const runs::StoredFiles cell = store.files(key);
    recording = runs::load_recording(store.recording(key.scenario, key.seed));
    result = runs::load_result(cell);
    rules = segment_rules(scenario.metrics);
    rows.emplace(cell);
    const std::string wanted = choice.frame == "worst" ? std::to_string(rows->worst_frame()) : choice.frame;
    frame = frame_number(wanted, recording.observed.frames.size());
  }

  render::NamedResult named(const std::string& name) const {
    return {name, &result, nullptr, line_verdicts(recording, result, rules)};
  }

  runs::CellKey key;
  Recording recording;
  PipelineResult result;
  metrics::SegmentRules rules;
  std::optional<ScanRows> rows;
  std::size_t frame = 0;
};

/// The same ranges to the bit; a beam without a return may be NaN.
bool is_same_scan(const ChosenCell& a, const ChosenCell& b) {
  if (a.frame >= b.recording.observed.frames.size()) return false;
  return std::ranges::equal(a.recording.observed.scan(a.frame).ranges, b.recording.observed.scan(a.frame).ranges,
                            [](double x, double y) { return x == y || (std::isnan(x) && std::isnan(y)); });
}

ShownScan drawn_scan(const ChosenCell& cell, std::vector<render::NamedResult> results) {
  render::FigureInput input{.title = words_of_name(cell.key.scenario),
                            .recording = cell.recording,
                            .waypoints = {},
                            .results = std::move(results)};
  auto drawn =
      Registry<render::Figure>::make("scan_overlay", {{"frame", static_cast<std::int64_t>(cell.frame)}})->draw(input);
  if (drawn.empty()) throw ConfigError("there is nothing to draw of " + runs::to_string(cell.key));
  return {.name = fmt::format("{}_{}_{}_scan_{}", cell.key.scenario, cell.key.pipeline, cell.key.seed, cell.frame),
          .text = fmt::format("{}, scan {} (0 to {})", runs::to_string(cell.key), cell.frame,
                              cell.recording.observed.frames.size() - 1),
          .frame = cell.frame,
          .scene = std::move(drawn.front().scene)};
}

/// A panel of the scene with the view that it has beside the others, without title and legend.
render::Scene panel_alone(render::Scene scene, std::size_t panel) {
  scene.panels = {scene.panels[panel]};
  scene.columns = 1;
  scene.width_in = render::kSingleColumnIn;
  scene.title.clear();
  scene.legend.clear();
  scene.scale_bar = false;
  return scene;
}

}  // namespace

ShownScan show_scan(const fs::path& run, const ScanChoice& choice) {
  const ChosenCell cell(run, choice);
  ShownScan shown = drawn_scan(cell, {cell.named(cell.key.pipeline)});
  if (const std::string counts = cell.rows->text(cell.frame); !counts.empty()) shown.text += ": " + counts;
  return shown;
}

std::optional<ShownInBoth> show_scan_in_both(const fs::path& before, const fs::path& now, const ScanChoice& choice) {
  const ChosenCell cell(now, choice);
  const ChosenCell earlier(before, {.scenario = cell.key.scenario,
                                    .pipeline = cell.key.pipeline,
                                    .seed = cell.key.seed,
                                    .frame = std::to_string(cell.frame)});
  if (!is_same_scan(earlier, cell)) return std::nullopt;
  std::vector<render::NamedResult> results{earlier.named("before"), cell.named("now")};
  const bool judged = !results.back().verdicts.empty();
  ShownScan both = drawn_scan(cell, std::move(results));  // one panel if the lines are equal
  ShownInBoth pair{both, both, both.scene.panels.size() == 1, judged};
  pair.before.text = earlier.rows->counts(cell.frame);
  pair.before.scene = panel_alone(both.scene, 0);
  pair.now.text = cell.rows->counts(cell.frame);
  pair.now.scene = panel_alone(both.scene, both.scene.panels.size() - 1);
  return pair;
}

std::string picture_bytes(const render::Scene& scene, const fs::path& path, double dpi) {
  const std::string ending = path.extension().string();
  if (ending == ".png") return render::to_png(scene, dpi);
  if (ending == ".svg") return render::to_svg(scene);
  if (ending == ".pdf") return render::to_pdf(scene);
  throw ConfigError(path.string() + ": a picture's name ends in .png, .svg or .pdf");
}

}  // namespace scanbench::results
