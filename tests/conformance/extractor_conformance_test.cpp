// Every registered line extractor, with its defaults, passes the checks of `scanbench module conform`. New modules are
// tested as soon as they register themselves.
#include <gtest/gtest.h>

#include <map>
#include <string>

#include "core/modules.hpp"
#include "core/registry.hpp"
#include "harness/study/conform/extractor_checks.hpp"

namespace scanbench {
namespace {

// Checks that an extractor does not pass by design, and why.
const std::map<std::pair<std::string, std::string>, std::string> kByDesign = {
    {{"hough", "TheLinesTurnWithTheSceneAboutTheSensor"}, "its accumulator has fixed angles"},
    {{"fuzzy_lines", "ANoiseFreeWallIsOneLine"}, "the number of lines is its parameter"},
};

class ExtractorConformance : public ::testing::TestWithParam<std::string> {
 protected:
  void pass(const std::string& name) const {
    if (const auto found = kByDesign.find({GetParam(), name}); found != kByDesign.end()) GTEST_SKIP() << found->second;
    const auto& entry = *Registry<LineExtractor>::find(GetParam());
    for (const auto& check : study::conform::extractor_checks()) {
      if (check.name != name) continue;
      study::conform::Findings findings;
      check.run({entry.params, entry.make}, findings);
      for (const auto& fault : findings.faults()) ADD_FAILURE() << fault;
      return;
    }
    FAIL() << "there is no check " << name;
  }
};
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(ExtractorConformance);
INSTANTIATE_TEST_SUITE_P(All, ExtractorConformance, ::testing::ValuesIn(Registry<LineExtractor>::names()),
                         [](const auto& test) { return test.param; });

// A test per check, so that ctest names what fails.
#define SCANBENCH_CHECK(name)          \
  TEST_P(ExtractorConformance, name) { \
    pass(#name);                       \
  }
SCANBENCH_CHECK(AScanWithoutBeamsHasNoLines)
SCANBENCH_CHECK(AScanWithoutReturnsHasNoLines)
SCANBENCH_CHECK(OneTwoAndThreeReturnsAreAnswered)
SCANBENCH_CHECK(EqualPointsCirclesAndWallsSeenEdgeOnAreAnswered)
SCANBENCH_CHECK(ANoiseFreeWallHasItsLineInItsPlace)
SCANBENCH_CHECK(ANoiseFreeWallIsOneLine)
SCANBENCH_CHECK(AClockwiseScannerGivesTheSameWallWithTheSensorOnItsLeft)
SCANBENCH_CHECK(ACornerIsAnswered)
SCANBENCH_CHECK(AWallAcrossTheSeamOfAFullTurnIsFoundOnBothSides)
SCANBENCH_CHECK(TenAndAHundredThousandBeamsAreAnswered)
SCANBENCH_CHECK(RoomsWithHolesAreAnswered)
SCANBENCH_CHECK(HugeAndTinyScenesAreAnswered)
SCANBENCH_CHECK(TheLinesTurnWithTheSceneAboutTheSensor)
SCANBENCH_CHECK(TheAnswerIsTheSameTwiceAndTheScanUntouched)
SCANBENCH_CHECK(EveryParameterAtItsEndsGivesAConsistentAnswer)
#undef SCANBENCH_CHECK

TEST(ExtractorChecks, AreAllRunHere) {
  EXPECT_EQ(study::conform::extractor_checks().size(), 15u);
}

}  // namespace
}  // namespace scanbench
