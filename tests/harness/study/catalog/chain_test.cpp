// The grammar of a pipeline: every sequence of up to three slots against a regular expression.
#include "harness/study/catalog/chain.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>

namespace scanbench::study {
namespace {

PipelineSpec pipeline_of(const std::vector<std::string>& kinds) {
  PipelineSpec pipeline{"p", {}, ""};
  for (const auto& kind : kinds) pipeline.slots.push_back({kind, "any", {}});
  return pipeline;
}

TEST(Chain, AcceptsExactlyTheSequencesOfTheGrammar) {
  const std::vector<std::string> kinds = {"extract", "align", "match", "map", "merge", "metrics"};
  const std::regex with_scans("extract (align |match )?(map |merge )?");
  const std::regex without("(align |match )(map |merge )?|(map |merge )");
  int accepted = 0;
  const auto check = [&](const std::vector<std::string>& sequence) {
    std::string text;
    for (const auto& kind : sequence) text += kind + " ";
    const bool good = !chain_fault(pipeline_of(sequence), true).has_value();
    EXPECT_EQ(good, std::regex_match(text, with_scans)) << text;
    EXPECT_EQ(!chain_fault(pipeline_of(sequence), false).has_value(), std::regex_match(text, without)) << text;
    accepted += good ? 1 : 0;
  };
  check({});
  for (const auto& a : kinds) {
    check({a});
    for (const auto& b : kinds) {
      check({a, b});
      for (const auto& c : kinds) check({a, b, c});
    }
  }
  EXPECT_EQ(accepted, 9);  // 3 choices of poses times 3 of maps
}

TEST(Chain, NamesTheWrongSlot) {
  const auto fault = chain_fault(pipeline_of({"extract", "align", "match"}), true);
  ASSERT_TRUE(fault.has_value());
  EXPECT_EQ(fault->slot, 2U);
  EXPECT_EQ(fault->message, "pipeline p has both align and match; allowed: one of them");
  EXPECT_EQ(chain_fault(pipeline_of({"merge"}), true)->message,
            "pipeline p has no 'extract'; allowed: extract, then align or match, then map or merge");
  EXPECT_EQ(chain_text(false), "align or match, then map or merge");
}

}  // namespace
}  // namespace scanbench::study
