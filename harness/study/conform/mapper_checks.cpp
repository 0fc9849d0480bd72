// Checks of mappers, on series of scans with their lines. A mapper is not required to merge lines or to correct poses.
#include "harness/study/conform/mapper_checks.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/special_values.hpp"
#include "harness/study/conform/scenes.hpp"

namespace scanbench::study::conform {
namespace {

using Mappers = Subject<Mapper>;

/// Everything that core/modules.hpp promises about an insertion and the map after it.
void check(const Insertion& step, const LineMap& map, Findings& findings) {
  findings.expect(step.world_from_sensor.translation().allFinite() && std::isfinite(step.world_from_sensor.yaw()),
                  "the pose is not finite");
  findings.expect(step.lines >= static_cast<int>(map.lines.size()), "the map has " + std::to_string(map.lines.size()) +
                                                                        " lines, of which insert() names " +
                                                                        std::to_string(step.lines));
  findings.expect(step.status != Status::no_match || !step.message.empty(),
                  "the status is no_match, and no message says why");
  for (std::size_t k = 0; k < map.lines.size(); ++k) {
    const MapLine& line = map.lines[k];
    const std::string place = "map line " + std::to_string(k);
    findings.expect(line.segment.a.allFinite() && line.segment.b.allFinite() && line.covariance.allFinite(),
                    place + " is not finite");
    findings.expect(line.segment.length() > 0.0, place + " has no length");
    findings.expect(line.members >= 1 && line.points >= 0, place + " has no members, or a negative number of points");
  }
}

struct Mapped {
  std::vector<Insertion> steps;
  std::vector<LineMap> maps;  ///< after each step
};

Mapped map(Mapper& module, const Series& series, const std::vector<Pose2>& guesses, Findings& findings,
           Trace trace = {}) {
  Mapped result;
  const auto observations = series.observations();
  for (std::size_t k = 0; k < observations.size(); ++k) {
    result.steps.push_back(module.insert(observations[k], guesses[k], trace));
    result.maps.push_back(module.map());
    check(result.steps.back(), result.maps.back(), findings);
  }
  return result;
}

Mapped map(const Mappers& subject, const Series& series, const std::vector<Pose2>& guesses, Findings& findings) {
  return map(*subject.make({}), series, guesses, findings);
}

bool same_lines(const LineMap& a, const LineMap& b) {
  return std::ranges::equal(a.lines, b.lines, [](const MapLine& x, const MapLine& y) {
    return x.segment == y.segment && x.covariance == y.covariance && x.members == y.members && x.points == y.points;
  });
}

void map_no_scans(const Mappers& subject, Findings& findings) {
  findings.expect(subject.make({})->map().lines.empty(), "without a scan there are map lines");
}

void map_after_each_scan(const Mappers& subject, Findings& findings) {
  const Mapped mapped = map(subject, drive(6), stops(6), findings);
  for (std::size_t k = 0; k < mapped.maps.size(); ++k)
    findings.expect(!mapped.maps[k].lines.empty(), "after scan " + std::to_string(k) + " of a room the map is empty");
}

void map_again(const Mappers& subject, Findings& findings) {
  const Series series = drive(5);
  const auto module = subject.make({});
  const Mapped first = map(*module, series, stops(5), findings);
  findings.expect(same_lines(module->map(), first.maps.back()), "map() gives another map the second time");
  const auto expect_equal = [&](const Mapped& other, const std::string& fault) {
    bool equal = same_lines(first.maps.back(), other.maps.back());
    for (std::size_t k = 0; k < first.steps.size(); ++k)
      equal = equal && first.steps[k].status == other.steps[k].status &&
              first.steps[k].world_from_sensor == other.steps[k].world_from_sensor;
    findings.expect(equal, fault);
  };
  expect_equal(map(subject, series, stops(5), findings), "a second instance makes another map of the same scans");
  expect_equal(map(*subject.make({}), series, stops(5), findings, listening_trace()),
               "a trace that listens changes the map");
  const Series fresh = drive(5);
  for (std::size_t k = 0; k < series.size(); ++k)
    findings.expect(series.scan(k).ranges == fresh.scan(k).ranges, "a scan was changed");
}

void map_moves(const Mappers& subject, Findings& findings) {
  const Pose2 moved(30, -12, 2.2);
  const LineMap still = map(subject, drive(5), stops(5), findings).maps.back();
  const LineMap after = map(subject, drive(5), stops(5, moved), findings).maps.back();
  findings.expect(std::ranges::equal(
                      after.lines, still.lines,
                      [&](const MapLine& a, const MapLine& b) { return is_near(a.segment, moved * b.segment, 1e-6); }),
                  "the map does not move with the poses");
}

void map_without_returns(const Mappers& subject, Findings& findings) {
  for (const double range : {kInf, kNaN, -kInf}) {
    Series series;
    series.add(drive(1).scan(0));
    series.add(constant_scan(ring_sensor(361), range));
    series.add(drive(2).scan(1));
    const Mapped mapped = map(subject, series, stops(3), findings);
    findings.expect(mapped.steps[1].status == Status::no_match, "a scan without returns is not no_match");
    findings.expect(mapped.maps[1].lines.size() == mapped.maps[0].lines.size(),
                    "a scan without returns changes the map");
    findings.expect(mapped.steps[2].status != Status::no_match, "after a scan without returns nothing is mapped");
  }
}

void empty_first(const Mappers& subject, Findings& findings) {
  Series series;
  series.add(constant_scan(ring_sensor(361), kInf));
  series.add(drive(2).scan(1));
  const Mapped mapped = map(subject, series, stops(2), findings);
  findings.expect(mapped.maps[0].lines.empty(), "a scan without returns gives map lines");
  findings.expect(!mapped.maps[1].lines.empty(), "after a scan without returns the next one gives no map");
}

void bad_lines(const Mappers& subject, Findings& findings) {
  const Series series = drive(1);
  const Observation good = series.observations().front();
  ScanLines lines = good.lines;
  for (const double bad : {kNaN, kInf}) {
    LineFeature line = good.lines.lines.front();
    line.segment.b.x() = bad;
    lines.lines.push_back(line);
  }
  LineFeature point = good.lines.lines.front();
  point.segment.b = point.segment.a;
  lines.lines.push_back(point);
  const auto module = subject.make({});
  Trace silent;
  const Insertion step = module->insert({good.scan, lines}, {}, silent);
  check(step, module->map(), findings);
}

}  // namespace

const std::vector<Check<Mapper>>& mapper_checks() {
  static const std::vector<Check<Mapper>> checks{
      {"NothingInsertedIsAnEmptyMap", map_no_scans},
      {"AMapIsReadyAfterEveryScan", map_after_each_scan},
      {"TheSameScansGiveTheSameMap", map_again},
      {"MovingAllPosesMovesTheMap", map_moves},
      {"AScanWithoutReturnsIsReportedAndLeavesTheMapAsItIs", map_without_returns},
      {"AnEmptyScanFirstIsNoMapAndTheNextOneIsTheMap", empty_first},
      {"LinesThatAreNotFiniteOrHaveNoLengthAreNotInTheMap", bad_lines},
  };
  return checks;
}

}  // namespace scanbench::study::conform
