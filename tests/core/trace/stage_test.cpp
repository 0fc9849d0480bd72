// Stages and their names in timing.csv.
#include <set>

#include <gtest/gtest.h>

#include "core/trace/stage.hpp"
#include "core/trace/stage_time.hpp"

namespace scanbench {
namespace {

TEST(Stage, EveryStageHasANameOfItsOwnThatNamesIt) {
  std::set<std::string_view> seen;
  for (const std::string_view name : stage_names()) {
    EXPECT_TRUE(seen.insert(name).second) << name;
    ASSERT_TRUE(stage_named(name)) << name;
    EXPECT_EQ(to_string(*stage_named(name)), name);
  }
  EXPECT_EQ(to_string(Stage::pre), "pre");
  EXPECT_EQ(to_string(Stage::joint), "joint");
  EXPECT_FALSE(stage_named("Pre"));
  EXPECT_FALSE(stage_named(""));
}

TEST(StageTime, IsLabelledByItsStageInExtractionAndBySlotAndStageElsewhere) {
  EXPECT_EQ((StageTime{.slot = "extract", .stage = Stage::pre}).label(), "pre");
  EXPECT_EQ((StageTime{.slot = "merge", .stage = Stage::phase1}).label(), "merge.phase1");
  EXPECT_EQ((StageTime{.slot = "align", .stage = {}}).label(), "align");
}

TEST(StageTime, EveryLabelOfASlotsOwnStagesIsReadBack) {
  // Extractors, matchers and mappers work on frames, aligners and mergers on whole recordings (-1).
  for (const auto& [slot, frame] : {std::pair("extract", 3), std::pair("match", 3), std::pair("map", 0),
                                    std::pair("align", -1), std::pair("merge", -1)}) {
    std::vector<std::optional<Stage>> stages{std::nullopt};
    for (const std::string_view name : stage_names()) stages.push_back(stage_named(name));
    for (const auto& stage : stages) {
      if (std::string_view(slot) == "extract" && stage == Stage::match) continue;  // the label of a matcher
      const StageTime time{.slot = slot, .stage = stage, .frame = frame, .seconds = 1.0};
      const auto read = stage_time_labelled(time.label(), frame);
      ASSERT_TRUE(read) << time.label();
      EXPECT_EQ(read->slot, slot) << time.label();
      EXPECT_EQ(read->stage, stage) << time.label();
      EXPECT_EQ(read->frame, frame);
      EXPECT_EQ(read->seconds, 0.0);
    }
  }
}

TEST(StageTime, ALabelOfNoSlotAndNoStageIsRefused) {
  for (const char* label : {"", ".", "warp", "merge.", "merge.warp", "warp.pre", ".pre", "merge.pre.fit"})
    for (const int frame : {-1, 0}) EXPECT_FALSE(stage_time_labelled(label, frame)) << label;
}

}  // namespace
}  // namespace scanbench
