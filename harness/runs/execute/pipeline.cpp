// Runs the chain extract -> (align | match) -> (map | merge) on all scans.
#include "harness/runs/execute/pipeline.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <span>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/geometry/angles.hpp"
#include "core/geometry/symmetric_matrix.hpp"
#include "core/modules.hpp"
#include "harness/runs/execute/stopwatch.hpp"
#include "harness/study/catalog/chain.hpp"
#include "harness/study/catalog/make_module.hpp"
#include "harness/study/foreign/arithmetic.hpp"
#include "harness/study/foreign/fault.hpp"

namespace scanbench::runs {
namespace {

/// Makes a module's trace for one slot and frame (-1: the whole recording), calls the module with it, and stores what
/// the pass records.
using Listener = std::function<void(std::string_view slot, int frame, const std::function<void(Trace&)>& call)>;

/// "extract, frame 3: ".
std::string place_of(std::string_view slot, int frame) {
  return std::string(slot) + (frame < 0 ? "" : ", frame " + std::to_string(frame)) + ": ";
}

/// Calls a module; its faults get the slot and the frame.
void call_at(std::string_view slot, int frame, const std::function<void(Trace&)>& call, Trace& trace) {
  try {
    const study::Arithmetic arithmetic;
    call(trace);
    if (arithmetic.restore())
      throw InvalidResult("the module changed the floating-point arithmetic of its process, and did not restore it");
  } catch (const study::ForeignFault& fault) {
    throw study::ForeignFault(place_of(slot, frame) + fault.what(), fault.kind());
  } catch (const InvalidResult& error) {
    throw InvalidResult(place_of(slot, frame) + error.what());
  }
}

void nobody_listens(std::string_view slot, int frame, const std::function<void(Trace&)>& call) {
  Trace silent;
  call_at(slot, frame, call, silent);
}

Listener timed_into(std::vector<StageTime>& times) {
  return [&times, watch = Stopwatch()](std::string_view slot, int frame, const auto& call) mutable {
    Trace trace = watch.start();
    call_at(slot, frame, call, trace);
    watch.stop(slot, frame, times);
  };
}

Listener written_into(Journal& journal) {
  return [&journal](std::string_view slot, int frame, const auto& call) {
    Trace trace = journal.begin(slot, frame);
    call_at(slot, frame, call, trace);
  };
}

constexpr double kFarthest_m = 1e6;  // larger than every scanner's range and every path of a robot
constexpr double kOffLine_m = 1e-3;  // of an end point from its line, at 1 m; far more than rounding to float32

bool is_near(const Vec2& p) {
  return p.cwiseAbs().maxCoeff() < kFarthest_m;
}

/// Describes what is wrong with a covariance, within rounding; empty if nothing is.
template <int n>
std::string covariance_fault(const Eigen::Matrix<double, n, n>& covariance) {
  constexpr double kRounding = 1e-9;
  if (!covariance.allFinite()) return "a covariance that is not finite";
  if (covariance.diagonal().minCoeff() < 0) return "a negative variance";
  if ((covariance - covariance.transpose()).norm() > kRounding * covariance.norm())
    return "a covariance that is not symmetric";
  const Eigen::Matrix<double, n, 1> variances = symmetric_eigenvalues(covariance);
  if (variances.minCoeff() < -kRounding * variances.maxCoeff()) return "a covariance with a negative eigenvalue";
  return "";
}

/// Describes what is wrong with a line; empty if nothing is. Lines given instead of scans have no beams and may have
/// any size.
std::string fault_of(const LineFeature& line, int beams) {
  if (!line.segment.a.allFinite() || !line.segment.b.allFinite() || !std::isfinite(line.line.rho) ||
      !std::isfinite(line.line.alpha))
    return "is not finite";
  if (line.line.rho < 0 || !(line.line.alpha > -kPi && line.line.alpha <= kPi))
    return fmt::format("has rho {} m and alpha {} rad; allowed: >= 0 and > -pi .. pi", line.line.rho, line.line.alpha);
  for (const Vec2& end : {line.segment.a, line.segment.b})
    if (const double off = std::fabs(line.line.signed_distance(end)); off > kOffLine_m * std::max(1.0, end.norm()))
      return fmt::format("has an end point {:.4g} m off the line of its rho and alpha", off);
  if (line.covariance)
    if (const std::string fault = covariance_fault(*line.covariance); !fault.empty()) return "has " + fault;
  if (line.points < 0) return "has " + std::to_string(line.points) + " points";
  if (!std::isfinite(line.rms_m) || line.rms_m < 0) return "has an rms that is not finite or negative";
  if (beams == 0) return "";
  const auto exists = [&](int beam) { return beam >= 0 && beam < beams; };
  if (!exists(line.first_beam) || !exists(line.last_beam))
    return "goes from beam " + std::to_string(line.first_beam) + " to beam " + std::to_string(line.last_beam) +
           "; allowed: 0 .. " + std::to_string(beams - 1);
  if (!is_near(line.segment.a) || !is_near(line.segment.b)) return "has an end point beyond 1e6 m";
  return "";
}

void check_lines(const ScanLines& lines, int beams, std::size_t frame) {
  const auto refuse = [&](const std::string& what) {
    throw InvalidResult("extract, frame " + std::to_string(frame) + ": " + what);
  };
  if (lines.labels.size() != static_cast<std::size_t>(beams))
    refuse(std::to_string(lines.labels.size()) + " labels for " + std::to_string(beams) + " beams");
  for (const int label : lines.labels)
    if (label < -1 || label >= static_cast<int>(lines.lines.size()))
      refuse("label " + std::to_string(label) + " with " + std::to_string(lines.lines.size()) + " lines");
  for (std::size_t i = 0; i < lines.lines.size(); ++i) {
    if (const std::string fault = fault_of(lines.lines[i], beams); !fault.empty())
      refuse("line " + std::to_string(i) + " " + fault);
  }
}

/// `from`: the place of the first scan by its odometry, which may be far from zero, as in coordinates of a map.
void check_pose(const Pose2& pose, const Vec2& from, const std::string& where) {
  if (!pose.translation().allFinite() || !std::isfinite(pose.cos()) || !std::isfinite(pose.sin()))
    throw InvalidResult(where + ": the pose is not finite");
  if (!is_near(pose.translation() - from)) throw InvalidResult(where + ": the pose is beyond 1e6 m");
}

void check_match(const Match& match, const std::string& where) {
  check_pose(match.reference_from_current, Vec2::Zero(), where);
  if (const std::string fault = covariance_fault(match.covariance); !fault.empty())
    throw InvalidResult(where + ": the match has " + fault);
}

/// False if all scans claim one pose: what recorded scans without poses look like.
bool has_odometry(const ScanSet& scans) {
  return std::ranges::any_of(
      scans.frames, [&](const Frame& frame) { return !(frame.odom_from_sensor == scans.frames[0].odom_from_sensor); });
}

void check_map(const LineMap& map, const std::string& slot) {
  for (std::size_t i = 0; i < map.lines.size(); ++i)
    if (!map.lines[i].segment.a.allFinite() || !map.lines[i].segment.b.allFinite() ||
        !map.lines[i].covariance.allFinite())
      throw InvalidResult(slot + ": map line " + std::to_string(i) + " is not finite");
  for (std::size_t i = 0; i < map.lines.size(); ++i)
    if (map.lines[i].members < 0 || map.lines[i].points < 0)
      throw InvalidResult(slot + ": map line " + std::to_string(i) + " has a negative number of members or points");
}

/// One pass over the slots after `extract`.
class Chain {
 public:
  Chain(const ScanSet& scans, PipelineResult& result, const Listener& listener, const study::ForeignSetting& foreign,
        int skip_matches = 0)
      : scans_(scans), result_(result), listener_(listener), foreign_(foreign), skip_matches_(skip_matches) {
    views_.reserve(scans.frames.size());
    for (std::size_t k = 0; k < scans.frames.size(); ++k) {
      views_.push_back(scans.scan(k));
      poses_.push_back(scans.frames[k].odom_from_sensor);
    }
  }

  void run(const study::ModuleChoice& slot) {
    if (slot.kind == "align") {
      align(slot);
    } else if (slot.kind == "match") {
      match(slot);
    } else if (slot.kind == "map") {
      map(slot);
    } else {
      merge(slot);
    }
    result_.world_from_sensor = poses_;
  }

  std::string remarks() const {
    std::string text;
    for (const auto& [slot, counts] : outcomes_) {
      text += (text.empty() ? "" : "; ") + slot + ": ";
      bool first = true;
      for (const auto& [status, count] : counts) {
        text += (first ? "" : ", ") + std::to_string(count) + " " + std::string(to_string(status));
        first = false;
      }
      const auto message = messages_.find(slot);
      if (message != messages_.end() && !message->second.empty()) text += " (" + message->second + ")";
    }
    return text;
  }

 private:
  Observation observation(std::size_t k) const { return {views_[k], result_.lines[k]}; }
  const Vec2& start() const { return scans_.frames.front().odom_from_sensor.translation(); }

  void note(const std::string& slot, Status status) {
    if (status != Status::converged) ++outcomes_[slot][status];
  }

  void align(const study::ModuleChoice& slot) {
    const auto aligner = study::make_module<Aligner>(slot, foreign_);
    std::vector<Observation> observations;
    for (std::size_t k = 0; k < views_.size(); ++k) observations.push_back(observation(k));
    Alignment alignment;
    listener_("align", -1, [&](Trace& trace) { alignment = aligner->align(observations, poses_, trace); });
    note("align", alignment.status);
    if (alignment.status != Status::converged) messages_["align"] = alignment.message;
    if (alignment.world_from_sensor.size() != poses_.size())
      throw InvalidResult("align: " + std::to_string(alignment.world_from_sensor.size()) + " poses for " +
                          std::to_string(poses_.size()) + " scans");
    for (std::size_t k = 0; k < poses_.size(); ++k)
      check_pose(alignment.world_from_sensor[k], start(), "align, frame " + std::to_string(k));
    poses_ = std::move(alignment.world_from_sensor);
  }

  void match(const study::ModuleChoice& slot) {
    const auto matcher = study::make_module<ScanMatcher>(slot, foreign_);
    const bool odometry = has_odometry(scans_);
    for (std::size_t k = 1; k < views_.size(); ++k) {
      // Without odometry the sensor is taken to go on as it went from the scan before the last one to the last.
      const Pose2 guess = odometry ? scans_.frames[k - 1].odom_from_sensor.inverse() * scans_.frames[k].odom_from_sensor
                          : k > 1  ? poses_[k - 2].inverse() * poses_[k - 1]
                                   : Pose2();
      Match found;
      listener_("match", static_cast<int>(k),
                [&](Trace& trace) { found = matcher->match(observation(k - 1), observation(k), guess, trace); });
      note("match", found.status);
      check_match(found, "match, frame " + std::to_string(k));
      result_.matches.push_back({.frame = static_cast<int>(k), .reference = static_cast<int>(k) - 1, .match = found});
      poses_[k] = poses_[k - 1] * (found.status == Status::no_match ? guess : found.reference_from_current);
    }
    if (skip_matches_ > 0 && views_.size() > 2) match_last_but_one(*matcher, odometry);
  }

  /// The guess does not use the matches of these scans with the one between them, so that both may be compared.
  void match_last_but_one(const ScanMatcher& matcher, bool odometry) {
    const std::size_t all = views_.size() - 2, most = static_cast<std::size_t>(skip_matches_);
    for (std::size_t k = 2; k < views_.size(); k += (all + most - 1) / most) {
      const Pose2 step = k > 2 ? poses_[k - 3].inverse() * poses_[k - 2] : Pose2();
      const Pose2 guess =
          odometry ? scans_.frames[k - 2].odom_from_sensor.inverse() * scans_.frames[k].odom_from_sensor : step * step;
      Match found;
      nobody_listens("match", static_cast<int>(k),
                     [&](Trace& trace) { found = matcher.match(observation(k - 2), observation(k), guess, trace); });
      check_match(found, "match, frame " + std::to_string(k) + " with the last but one");
      result_.skip_matches.push_back(
          {.frame = static_cast<int>(k), .reference = static_cast<int>(k) - 2, .match = found});
    }
  }

  void map(const study::ModuleChoice& slot) {
    const auto mapper = study::make_module<Mapper>(slot, foreign_);
    std::vector<Pose2> placed;
    for (std::size_t k = 0; k < views_.size(); ++k) {
      Insertion inserted;
      listener_("map", static_cast<int>(k),
                [&](Trace& trace) { inserted = mapper->insert(observation(k), poses_[k], trace); });
      note("map", inserted.status);
      const std::string frame = "frame " + std::to_string(k);
      if (inserted.status != Status::converged && !inserted.message.empty())
        messages_.try_emplace("map", "first in " + frame + ": " + inserted.message);
      check_pose(inserted.world_from_sensor, start(), "map, " + frame);
      if (inserted.lines < 0) throw InvalidResult("map, " + frame + ": " + std::to_string(inserted.lines) + " lines");
      placed.push_back(inserted.world_from_sensor);
    }
    poses_ = std::move(placed);
    result_.map = mapper->map();
    result_.has_map = true;
    check_map(result_.map, "map");
  }

  void merge(const study::ModuleChoice& slot) {
    const auto merger = study::make_module<SegmentMerger>(slot, foreign_);
    std::vector<MapLine> lines;
    std::vector<Vec2> points;
    std::vector<MergeLabel> labels;
    for (std::size_t k = 0; k < views_.size(); ++k) {
      const auto& found = result_.lines[k].lines;
      for (std::size_t i = 0; i < found.size(); ++i) {
        // Offset and angle at the midpoint do not change with a rigid motion, nor does their covariance.
        lines.push_back({.segment = poses_[k] * found[i].segment,
                         .covariance = found[i].covariance.value_or(Eigen::Matrix2d::Zero()),
                         .members = 1,
                         .points = found[i].points});
        labels.push_back({.frame = static_cast<int>(k), .line = static_cast<int>(i)});
      }
      for (const Vec2& p : valid_points(views_[k]).points) points.push_back(poses_[k] * p);
    }
    MergeResult merged;
    listener_("merge", -1, [&](Trace& trace) { merged = merger->merge({lines, points}, trace); });
    note("merge", merged.status);
    check_map(merged.map, "merge");
    const auto label_at = [&](const std::vector<int>& of, std::size_t i, const std::string& name, bool required) {
      if (of.empty() && !required) return -1;
      if (of.size() != lines.size())
        throw InvalidResult("merge: " + std::to_string(of.size()) + " entries in " + name + " for " +
                            std::to_string(lines.size()) + " lines");
      return of[i];
    };
    for (std::size_t i = 0; i < labels.size(); ++i) {
      labels[i].cluster1 = label_at(merged.cluster1, i, "cluster1", false);
      labels[i].cluster2 = label_at(merged.cluster2, i, "cluster2", false);
      labels[i].map_line = label_at(merged.labels, i, "labels", true);
      if (labels[i].map_line < -1 || labels[i].map_line >= static_cast<int>(merged.map.lines.size()))
        throw InvalidResult("merge: label " + std::to_string(labels[i].map_line) + " with " +
                            std::to_string(merged.map.lines.size()) + " map lines");
    }
    result_.map = std::move(merged.map);
    result_.has_map = true;
    result_.merge_labels = std::move(labels);
  }

  const ScanSet& scans_;
  PipelineResult& result_;
  const Listener& listener_;
  const study::ForeignSetting& foreign_;
  const int skip_matches_;
  std::vector<Scan> views_;
  std::vector<Pose2> poses_;
  std::map<std::string, std::map<Status, int>> outcomes_;
  std::map<std::string, std::string> messages_;
};

std::vector<ScanLines> extract_all(const LineExtractor& extractor, const ScanSet& scans, const Listener& listener) {
  std::vector<ScanLines> lines(scans.frames.size());
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const Scan scan = scans.scan(k);
    listener("extract", static_cast<int>(k), [&](Trace& trace) { lines[k] = extractor.extract(scan, trace); });
  }
  return lines;
}

/// Converts lines given instead of scans to an extractor's result.
std::vector<ScanLines> given_lines(const ScanSet& scans) {
  std::vector<ScanLines> lines(scans.frames.size());
  for (std::size_t k = 0; k < lines.size(); ++k)
    for (const Segment& segment : scans.frames[k].lines)
      lines[k].lines.push_back({.segment = segment, .line = line_through(segment.a, segment.b), .covariance = {}});
  return lines;
}

}  // namespace

PipelineRun run_pipeline(const study::PipelineSpec& pipeline, const ScanSet& scans, Journal* journal,
                         const study::ForeignSetting& foreign, int skip_matches) {
  const bool given = scans.has_given_lines();
  if (const auto fault = study::chain_fault(pipeline, !given)) throw ConfigError(fault->message);
  const std::span<const study::ModuleChoice> after_lines = std::span(pipeline.slots).subspan(given ? 0 : 1);
  std::unique_ptr<LineExtractor> extractor;
  if (!given) extractor = study::make_module<LineExtractor>(pipeline.slots.front(), foreign);
  const auto all_lines = [&](const Listener& listener) {
    return given ? given_lines(scans) : extract_all(*extractor, scans, listener);
  };

  PipelineRun run;
  run.result.lines = all_lines(nobody_listens);
  const int beams = scans.sensor.geometry.beams();
  for (std::size_t k = 0; k < run.result.lines.size(); ++k) check_lines(run.result.lines[k], beams, k);
  const Listener stopwatch = timed_into(run.result.times);
  all_lines(stopwatch);

  Chain chain(scans, run.result, stopwatch, foreign, skip_matches);
  for (const study::ModuleChoice& slot : after_lines) chain.run(slot);
  run.remarks = chain.remarks();

  if (journal != nullptr) {
    const Listener listener = written_into(*journal);
    PipelineResult again;
    again.lines = all_lines(listener);
    Chain journaled(scans, again, listener, foreign);
    for (const study::ModuleChoice& slot : after_lines) journaled.run(slot);
  }
  return run;
}

}  // namespace scanbench::runs
