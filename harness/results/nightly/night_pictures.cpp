// Chooses the scans and figures that show what became worse, and draws them as before and now.
#include "harness/results/nightly/night_pictures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>

#include "core/error.hpp"
#include "core/params.hpp"
#include "harness/io/files/atomic_file.hpp"
#include "harness/results/analysis/scan_change.hpp"
#include "harness/results/analysis/verdict.hpp"
#include "harness/results/figures/figures.hpp"
#include "harness/results/figures/shown_scan.hpp"
#include "harness/runs/store/manifest.hpp"
#include "harness/runs/store/run_scenarios.hpp"
#include "harness/runs/store/run_store.hpp"

namespace scanbench::results {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kPictures = 6;               // of scans, and of figures
constexpr std::uintmax_t kLargestFigure = 400000;  // bytes, so that the page stays small

std::string value_text(double value, const std::string& unit) {
  return fmt::format("{:.4g}", value) + (unit.empty() ? "" : " " + unit);
}

/// "f1 of scan 15 fell from 0.92 to 0.55".
std::string change_text(const ScanChange& change) {
  const std::string what = fmt::format("{} of scan {}", change.metric.metric, change.frame);
  const std::string before = value_text(change.before, "");
  if (!std::isfinite(change.after)) return fmt::format("{} is no longer defined, before {}", what, before);
  return fmt::format("{} {} from {} to {}", what, change.after < change.before ? "fell" : "rose", before,
                     value_text(change.after, change.metric.unit));
}

/// "f1 0.55; 8 right, 2 false, ...".
std::string caption_text(const std::string& when, double value, const ScanChange& change, const std::string& counts) {
  std::string text = fmt::format("{}: {} {}", when, change.metric.metric,
                                 std::isfinite(value) ? value_text(value, change.metric.unit) : "not defined");
  return text + (counts.empty() ? "" : "; " + counts);
}

/// The runs, and what is read from them more than once.
class Pictures {
 public:
  Pictures(const fs::path& run, const fs::path& before) : run_(run), now_(run) {
    if (!fs::exists(before / runs::kManifestFile)) return;
    before_ = before;
    earlier_.emplace(before);
    const std::string start = runs::load_provenance(before).start;  // 2026-11-24T10:14:02Z
    when_before_ = fmt::format("before ({} {} UTC)", start.substr(0, 10), start.size() > 16 ? start.substr(11, 5) : "");
  }

  /// The scan that shows this change best.
  PicturePair scan_of(const MetricChange& change, std::uint64_t seed) {
    const runs::CellKey key{change.scenario, change.pipeline, seed};
    PicturePair pair{fmt::format("{} in {}, seed {}", change.pipeline, change.scenario, seed)};
    const std::string& metric = change.metric.metric;
    if (!before_) return worst_now(key, "No earlier run is kept beside this one.", std::move(pair));
    try {
      const auto scan = most_changed_scan(*earlier_, now_, key, change.metric);
      if (!scan) {
        pair.note = metric + " has no values of single scans that changed, nor has any headline metric.";
        return pair;
      }
      const auto both = show_scan_in_both(*before_, run_, choice_of(key, scan->frame));
      if (!both) return worst_now(key, "The scans of this seed were others before.", std::move(pair));
      pair.title += ": " + change_text(*scan);
      pair.note = scan->substitute
                      ? fmt::format(
                            "{} has no values of single scans that changed. Of {} scans this is the one on which "
                            "{} changed most.",
                            metric, scan->scans, scan->metric.metric)
                      : fmt::format("The scan on which {} changed most, of {}.", metric, scan->scans);
      if (!both->same_lines)
        pair.before = PagePicture{caption_text(when_before_, scan->before, *scan, both->before.text),
                                  picture_bytes(both->before.scene, "scan.png")};
      pair.now = PagePicture{both->same_lines ? "The lines of this scan are the same as before: " + both->now.text
                                              : caption_text("now", scan->after, *scan, both->now.text),
                             picture_bytes(both->now.scene, "scan.png")};
      pair.scan = ScanPlace{key, scan->frame};
      pair.needs_key = both->judged;
      return pair;
    } catch (const ConfigError&) {  // a cell that the earlier run does not have
      return worst_now(key, "The earlier run does not have this cell.", std::move(pair));
    }
  }

  /// The figures of a scenario that changed. `change`: one of its gates that became worse.
  std::vector<PicturePair> figures_of(const study::Scenario& scenario, const MetricChange& change) {
    std::vector<PicturePair> figures;
    const auto now = load_figure_index(run_ / "figures");
    const auto before = before_ ? load_figure_index(*before_ / "figures") : std::vector<FigureFile>{};
    const auto same_scan = drawn_again(scenario, change);
    for (const auto& figure : now) {
      if (figure.name.empty() || figure.scenario != scenario.name) continue;
      PicturePair pair{figure.name};
      if (const auto drawn = same_scan.find(figure.name); drawn != same_scan.end()) {
        pair.before = drawn->second.before;
        pair.now = drawn->second.now;
      } else {
        pair.before = before_ ? picture_in(*before_, before, figure.name, when_before_) : std::nullopt;
        pair.now = picture_in(run_, now, figure.name, "now");
      }
      const bool is_equal = pair.before && pair.now && pair.before->png == pair.now->png;
      if (pair.now && !is_equal) figures.push_back(std::move(pair));
    }
    return figures;
  }

 private:
  static ScanChoice choice_of(const runs::CellKey& key, std::size_t frame) {
    return {.scenario = key.scenario, .pipeline = key.pipeline, .seed = key.seed, .frame = std::to_string(frame)};
  }

  /// The scan with the lowest F1 of this night alone.
  PicturePair worst_now(const runs::CellKey& key, const std::string& why, PicturePair pair) const {
    try {
      const ShownScan shown = show_scan(run_, {.scenario = key.scenario, .pipeline = key.pipeline, .seed = key.seed});
      pair.title += ": the scan with the lowest F1 now";
      pair.now = PagePicture{"now: " + shown.text, picture_bytes(shown.scene, "scan.png")};
      pair.scan = ScanPlace{key, shown.frame};
      pair.note = why;
    } catch (const ConfigError&) {  // a pipeline without lines, or a run without scans.csv
      pair.note = why + " No scan has an F1.";
    }
    return pair;
  }

  /// A figure from its file, with the caption of its own night.
  static std::optional<PagePicture> picture_in(const fs::path& folder, const std::vector<FigureFile>& index,
                                               const std::string& name, const std::string& when) {
    const fs::path file = folder / "figures" / (name + ".png");
    const auto figure = std::ranges::find(index, name, &FigureFile::name);
    if (figure == index.end() || !fs::exists(file) || fs::file_size(file) > kLargestFigure) return std::nullopt;
    return PagePicture{when + ": " + figure->caption, io::read_file(file)};
  }

  struct BothPictures {
    std::optional<PagePicture> before, now;
  };

  /// The figures that choose the scan that they show, both with the scan that changed most; by name.
  std::map<std::string, BothPictures> drawn_again(study::Scenario scenario, const MetricChange& change) {
    std::erase_if(scenario.figures, [](const study::ModuleChoice& figure) {
      return !shows_one_scan(figure) || to_text(figure.params.at("frame")) != "-1";
    });
    std::map<std::string, BothPictures> figures;
    if (!before_ || scenario.figures.empty()) return figures;
    try {
      const runs::CellKey key{scenario.name, change.pipeline, scenario.seeds.front()};
      const auto scan = most_changed_scan(*earlier_, now_, key, change.metric);
      if (!scan) return figures;
      const auto draw = [&](const fs::path& run, const std::string& when,
                            std::optional<PagePicture> BothPictures::*side) {
        for_each_figure(runs::RunStore(run), scenario, {.frame = scan->frame},
                        [&](const FigureFile& figure, const render::Scene& scene) {
                          if (figure.name.empty()) return;
                          std::string png = picture_bytes(scene, "figure.png");
                          if (png.size() > kLargestFigure) return;
                          figures[figure.name].*side = PagePicture{when + ": " + figure.caption, std::move(png)};
                        });
      };
      draw(run_, "now", &BothPictures::now);
      draw(*before_, when_before_, &BothPictures::before);
    } catch (const ConfigError&) {  // a cell or a recording that the earlier run does not have
      figures.clear();
    }
    return figures;
  }

  fs::path run_;
  std::optional<fs::path> before_;
  ScanValueReader now_;
  std::optional<ScanValueReader> earlier_;
  std::string when_before_;
};

}  // namespace

NightPictures night_pictures(const fs::path& run, const fs::path& before, const Comparison& comparison) {
  NightPictures shown;
  const auto worse = changes_with(comparison, Finding::worse);
  if (worse.empty()) return shown;
  Pictures pictures(run, before);
  std::vector<std::pair<std::string, std::string>> places;
  for (const MetricChange* change : worse) {
    const std::pair place{change->scenario, change->pipeline};
    const SeedPair* worst = change->worst();
    if (shown.scans.size() == kPictures || worst == nullptr || std::ranges::find(places, place) != places.end())
      continue;
    places.push_back(place);
    shown.scans.push_back(pictures.scan_of(*change, worst->seed));
  }
  for (const study::Scenario& scenario : runs::load_run_scenarios(run)) {
    const auto change = std::ranges::find(worse, scenario.name, &MetricChange::scenario);
    if (change == worse.end()) continue;
    for (auto& figure : pictures.figures_of(scenario, **change))
      if (shown.figures.size() < kPictures) shown.figures.push_back(std::move(figure));
  }
  return shown;
}

}  // namespace scanbench::results
