// Adapts programs to the interfaces of modules.
#include "harness/study/foreign/program_modules.hpp"

#include <span>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "harness/study/foreign/call.hpp"

namespace scanbench::study {
namespace {

class ProgramExtractor final : public LineExtractor {
 public:
  ProgramExtractor(const ForeignSource& source, const ParamSet& params, const ForeignSetting& setting)
      : session_(source, params, setting) {}

  ScanLines extract(const Scan& scan, Trace&) const override {
    return scan_lines_of(session_.send(std::move(Call("extract").scan("", scan)), &scan.sensor, 1));
  }

 private:
  mutable Session session_;  // what a program remembers must not change its answers, which conformance checks
};

class ProgramMatcher final : public ScanMatcher {
 public:
  ProgramMatcher(const ForeignSource& source, const ParamSet& params, const ForeignSetting& setting)
      : session_(source, params, setting) {}

  Match match(const Observation& reference, const Observation& current, const Pose2& guess, Trace&) const override {
    Call call("match");
    call.scan("reference.", reference.scan).lines("reference.", reference.lines);
    call.scan("current.", current.scan).lines("current.", current.lines);
    call.own("guess", to_rows(std::span(&guess, 1)));
    const Answer answer = session_.send(std::move(call), &current.scan.sensor, 1);
    const std::vector<Pose2> pose = poses_of(answer, "pose");
    if (pose.size() != 1) throw InvalidResult(std::to_string(pose.size()) + " poses; allowed: one");
    Match match{.status = status_of(answer), .reference_from_current = pose.front()};
    if (!answer.has("covariance")) return match;
    const std::span<const double> c = answer.array("covariance");
    if (c.size() != 9) throw InvalidResult("`covariance` has " + std::to_string(c.size()) + " numbers; allowed: 9");
    match.covariance = Eigen::Map<const Eigen::Matrix3d>(c.data()).transpose();
    return match;
  }

 private:
  mutable Session session_;
};

/// Scans one after the other in each array, and how many lines each has.
void add_observations(Call& call, std::span<const Observation> scans) {
  std::vector<double> ranges, stamps, counts, lines, covariances, labels;
  const auto append = [](std::vector<double>& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  for (const Observation& o : scans) {
    append(ranges, o.scan.ranges);
    stamps.push_back(o.scan.stamp_s);
    counts.push_back(static_cast<double>(o.lines.lines.size()));
    append(lines, to_rows(o.lines.lines));
    append(covariances, covariance_rows(o.lines.lines));
    append(labels, o.lines.labels);
  }
  call.own("ranges", std::move(ranges)).own("stamp_s", std::move(stamps)).own("line_counts", std::move(counts));
  call.own("lines", std::move(lines)).own("covariances", std::move(covariances)).own("labels", std::move(labels));
}

class ProgramAligner final : public Aligner {
 public:
  ProgramAligner(const ForeignSource& source, const ParamSet& params, const ForeignSetting& setting)
      : session_(source, params, setting) {}

  Alignment align(std::span<const Observation> scans, std::span<const Pose2> initial, Trace&) const override {
    if (scans.empty()) return {};
    Call call("align");
    add_observations(call, scans);
    call.own("initial", to_rows(initial));
    const Answer answer = session_.send(std::move(call), &scans.front().scan.sensor, 0);
    return {status_of(answer), poses_of(answer, "poses"), answer.text("message")};
  }

 private:
  mutable Session session_;
};

class ProgramMapper final : public Mapper {
 public:
  ProgramMapper(const ForeignSource& source, const ParamSet& params, const ForeignSetting& setting)
      : session_(source, params, setting) {}

  Insertion insert(const Observation& observation, const Pose2& guess, Trace&) override {
    Call call("insert");
    call.scan("", observation.scan).lines("", observation.lines).own("guess", to_rows(std::span(&guess, 1)));
    const Answer answer = session_.send(std::move(call), &observation.scan.sensor, 1);
    const std::vector<Pose2> pose = poses_of(answer, "pose");
    if (pose.size() != 1) throw InvalidResult(std::to_string(pose.size()) + " poses; allowed: one");
    const std::vector<int> lines = answer.integers("map_lines");
    if (lines.size() != 1) throw InvalidResult("`map_lines` is not one number");
    return {status_of(answer), pose.front(), lines.front(), answer.text("message")};
  }

  LineMap map() const override { return map_of(session_.send(Call("map"), nullptr, 0)); }

 private:
  mutable Session session_;
};

class ProgramMerger final : public SegmentMerger {
 public:
  ProgramMerger(const ForeignSource& source, const ParamSet& params, const ForeignSetting& setting)
      : session_(source, params, setting) {}

  MergeResult merge(const MergeInput& input, Trace&) const override {
    std::vector<double> points;
    for (const Vec2& p : input.points) points.insert(points.end(), {p.x(), p.y()});
    Call call("merge");
    call.own("lines", to_rows(input.lines)).own("points", std::move(points));
    const Answer answer = session_.send(std::move(call), nullptr, 0);
    MergeResult result{.status = status_of(answer),
                       .map = map_of(answer),
                       .labels = answer.integers("labels"),
                       .cluster1 = {},
                       .cluster2 = {}};
    if (answer.has("cluster1")) result.cluster1 = answer.integers("cluster1");
    if (answer.has("cluster2")) result.cluster2 = answer.integers("cluster2");
    return result;
  }

 private:
  mutable Session session_;
};

}  // namespace

template <>
std::unique_ptr<LineExtractor> run_program(const ForeignSource& s, const ParamSet& p, const ForeignSetting& setting) {
  return std::make_unique<ProgramExtractor>(s, p, setting);
}
template <>
std::unique_ptr<ScanMatcher> run_program(const ForeignSource& s, const ParamSet& p, const ForeignSetting& setting) {
  return std::make_unique<ProgramMatcher>(s, p, setting);
}
template <>
std::unique_ptr<Aligner> run_program(const ForeignSource& s, const ParamSet& p, const ForeignSetting& setting) {
  return std::make_unique<ProgramAligner>(s, p, setting);
}
template <>
std::unique_ptr<Mapper> run_program(const ForeignSource& s, const ParamSet& p, const ForeignSetting& setting) {
  return std::make_unique<ProgramMapper>(s, p, setting);
}
template <>
std::unique_ptr<SegmentMerger> run_program(const ForeignSource& s, const ParamSet& p, const ForeignSetting& setting) {
  return std::make_unique<ProgramMerger>(s, p, setting);
}

}  // namespace scanbench::study
