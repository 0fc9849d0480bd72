// Every registered segment merger, with its defaults, passes the checks of `scanbench module conform`.
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <utility>

#include "core/modules.hpp"
#include "core/registry.hpp"
#include "harness/study/conform/merger_checks.hpp"

namespace scanbench {
namespace {

// Checks that a module does not pass by design, and why.
const std::map<std::pair<std::string, std::string>, std::string> kMergersByDesign = {};

class MergerConformance : public ::testing::TestWithParam<std::string> {
 protected:
  void pass(const std::string& name) const {
    if (const auto found = kMergersByDesign.find({GetParam(), name}); found != kMergersByDesign.end())
      GTEST_SKIP() << found->second;
    const auto& entry = *Registry<SegmentMerger>::find(GetParam());
    for (const auto& check : study::conform::merger_checks()) {
      if (check.name != name) continue;
      study::conform::Findings findings;
      check.run({entry.params, entry.make}, findings);
      for (const auto& fault : findings.faults()) ADD_FAILURE() << fault;
      return;
    }
    FAIL() << "there is no check " << name;
  }
};
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(MergerConformance);
INSTANTIATE_TEST_SUITE_P(All, MergerConformance, ::testing::ValuesIn(Registry<SegmentMerger>::names()),
                         [](const auto& test) { return test.param; });

// A test per check, so that ctest names what fails.
#define SCANBENCH_CHECK(name)       \
  TEST_P(MergerConformance, name) { \
    pass(#name);                    \
  }
SCANBENCH_CHECK(NoSegmentsGiveAnEmptyMap)
SCANBENCH_CHECK(OneSegmentIsAnswered)
SCANBENCH_CHECK(IdenticalSegmentsBecomeOneInTheirPlace)
SCANBENCH_CHECK(SegmentsWithoutLengthAreAnswered)
SCANBENCH_CHECK(SegmentsThatAreNotFiniteAreDroppedAndChangeNothingElse)
SCANBENCH_CHECK(TheOrderOfTheSegmentsDoesNotMatter)
SCANBENCH_CHECK(TheMapMovesWithTheSegments)
SCANBENCH_CHECK(TheAnswerIsTheSameTwice)
#undef SCANBENCH_CHECK

TEST(MergerChecks, AreAllRunHere) {
  EXPECT_EQ(study::conform::merger_checks().size(), 8u);
}

}  // namespace
}  // namespace scanbench
