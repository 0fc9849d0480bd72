// Every registered module's trace: declared stages only, whose times fit timing.csv, and rows of declared schemas.
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "core/modules.hpp"
#include "core/registry.hpp"
#include "core/trace/stage_time.hpp"
#include "tests/support/aligning.hpp"
#include "tests/support/extraction.hpp"
#include "tests/support/merging.hpp"
#include "tests/support/trace_recorder.hpp"

namespace scanbench {
namespace {

using support::TraceRecorder;

/// A stop of a sensor in a room, with noise and lines.
struct TracedScan {
  explicit TracedScan(int stop)
      : scan(support::with_noise(support::cast(support::ring_sensor(361), support::random_room(3), pose(stop)), 0.01,
                                 static_cast<std::uint64_t>(stop))),
        view(scan.view()),
        lines(support::extract("iepf", scan)) {}
  static Pose2 pose(int stop) { return {0.1 * stop, 0.05 * stop, 0.1 * stop}; }
  Observation observation() const { return {view, lines}; }

  support::OwnedScan scan;
  Scan view;
  ScanLines lines;
};

/// Runs every module of every kind, and calls check(kind, name, frame, recorder) for each.
template <class Check>
void for_every_module(const Check& check) {
  const TracedScan first(0), second(1);
  for (const auto& name : Registry<LineExtractor>::names()) {
    TraceRecorder recorder("extract");
    Registry<LineExtractor>::make(name)->extract(first.view, recorder.trace);
    check("extract", name, 0, recorder);
  }
  for (const auto& name : Registry<ScanMatcher>::names()) {
    TraceRecorder recorder("match");
    Registry<ScanMatcher>::make(name)->match(first.observation(), second.observation(), {}, recorder.trace);
    check("match", name, 0, recorder);
  }
  for (const auto& name : Registry<Aligner>::names()) {
    TraceRecorder recorder("align");
    const std::vector<Observation> scans{first.observation(), second.observation()};
    Registry<Aligner>::make(name)->align(scans, std::vector{TracedScan::pose(0), TracedScan::pose(1)}, recorder.trace);
    check("align", name, -1, recorder);
  }
  for (const auto& name : Registry<Mapper>::names()) {
    TraceRecorder recorder("map");
    const auto mapper = Registry<Mapper>::make(name);
    for (const TracedScan* seen : {&first, &second}) mapper->insert(seen->observation(), {}, recorder.trace);
    check("map", name, 0, recorder);
  }
  std::vector<MapLine> lines;
  for (const LineFeature& line : first.lines.lines) lines.push_back({.segment = line.segment});
  for (const auto& name : Registry<SegmentMerger>::names()) {
    TraceRecorder recorder("merge");
    Registry<SegmentMerger>::make(name)->merge({lines, {}}, recorder.trace);
    check("merge", name, -1, recorder);
  }
}

TEST(TraceConformance, ExtractorsAndMergersNameTheStagesOfTheirWork) {
  for_every_module([](const std::string& kind, const std::string& name, int, const TraceRecorder& recorder) {
    if (kind == "extract" || kind == "merge") {
      EXPECT_FALSE(recorder.stages.empty()) << kind << " " << name;
    }
  });
}

TEST(TraceConformance, StagesAreDeclaredAndTheirTimesAreReadBackFromTheirLabels) {
  for_every_module([](const std::string& kind, const std::string& name, int frame, const TraceRecorder& recorder) {
    for (const Stage stage : recorder.stages) {
      ASSERT_LT(static_cast<std::size_t>(stage), stage_names().size()) << kind << " " << name;
      const StageTime time{.slot = kind, .stage = stage, .frame = frame};
      const auto read = stage_time_labelled(time.label(), frame);
      ASSERT_TRUE(read) << kind << " " << name << " " << time.label();
      EXPECT_EQ(read->slot, kind) << name << " " << time.label();
      EXPECT_EQ(read->stage, stage) << kind << " " << name << " " << time.label();
    }
  });
}

bool is_name(std::string_view text) {
  return !text.empty() && text.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_") == std::string_view::npos;
}

TEST(TraceConformance, RowsOfOneNameHaveOneSchemaWithNamedColumnsAndAValueForEach) {
  std::map<std::string, TraceSchema> known;  // by kind and name, which a reader of trace.csv uses
  for_every_module([&](const std::string& kind, const std::string& module, int, const TraceRecorder& recorder) {
    for (const TraceSchema& schema : recorder.schemas) {
      const std::string key = kind + "." + std::string(schema.name);
      const auto [place, is_new] = known.emplace(key, schema);
      EXPECT_EQ(place->second.columns, schema.columns) << key << " of " << module;
      if (!is_new) continue;
      EXPECT_TRUE(is_name(schema.name)) << key;
      EXPECT_FALSE(schema.columns.empty()) << key;
      std::set<std::string_view> columns;
      for (const std::string_view column : schema.columns) {
        EXPECT_TRUE(is_name(column)) << key << " " << column;
        EXPECT_TRUE(columns.insert(column).second) << key << " names a column twice: " << column;
      }
      for (const TraceRow& row : recorder.all_rows.at(key)) EXPECT_EQ(row.values.size(), schema.columns.size()) << key;
    }
  });
  EXPECT_TRUE(known.contains("merge.cluster"));  // the recorder gets what is written
}

}  // namespace
}  // namespace scanbench
