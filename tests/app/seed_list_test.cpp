// --seed: lists and ranges, and what is refused.
#include "app/seed_list.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/error.hpp"
#include "tests/app/program.hpp"

namespace scanbench::app_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(SeedList, TakesSeedsAndRangesInTheirOrder) {
  EXPECT_THAT(app::seeds_of({}), IsEmpty());
  EXPECT_THAT(app::seeds_of({"7"}), ElementsAre(7));
  EXPECT_THAT(app::seeds_of({"9", "1", "5-7", "3-3"}), ElementsAre(9, 1, 5, 6, 7, 3));
  EXPECT_THAT(app::seeds_of({"9007199254740991-9007199254740992"}), ElementsAre(9007199254740991, 9007199254740992));
  EXPECT_EQ(app::seeds_of({"1-100000"}).size(), 100000U);
}

TEST(SeedList, RefusesWhatIsNotARangeAndSaysTheLimit) {
  const auto refusal = [](const std::vector<std::string>& texts) {
    try {
      app::seeds_of(texts);
    } catch (const ConfigError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  for (const std::string text : {"", "-", "1-", "-3", "1--3", "1-2-3", "a", "1-b", "1.5", " 1", "1 - 3",
                                 "9007199254740993", "0-9007199254740993"})
    EXPECT_THAT(refusal({text}), HasSubstr("'" + text +
                                           "' is not a seed; allowed: whole numbers 0 .. 9007199254740992 "
                                           "and ranges of them, separated by commas: 1,3,5-7"));
  EXPECT_EQ(refusal({"20-1"}), "--seed: 20-1 is reversed; allowed: 1-20");
  EXPECT_EQ(refusal({"1-1000000"}), "--seed: with 1-1000000 there are 1000000 seeds; allowed: up to 100000");
  EXPECT_EQ(refusal({"1-60000", "70001-110001"}),
            "--seed: with 70001-110001 there are 100001 seeds; allowed: up to 100000");
  EXPECT_THAT(refusal({"0-9007199254740992"}), HasSubstr("allowed: up to 100000"));
  EXPECT_EQ(refusal({"1-5", "3"}), "--seed: 3 is given twice");
}

TEST(SeedList, IsTakenByEveryVerbThatHasSeeds) {
  const Folder folder;
  folder.write("room.yaml", room());
  for (const Args& verb :
       {Args{"run", "room.yaml"}, Args{"simulate", "room.yaml"}, Args{"sweep", "plan", "room.yaml", "--out", "s"},
        Args{"night", "run", "room.yaml", "--store", "n.sqlite"}}) {
    Args args = verb;
    args.insert(args.end(), {"--seed", "3-1"});
    const auto refused = run(args, {}, folder.path());
    EXPECT_EQ(refused.code, 2) << verb[0];
    EXPECT_THAT(refused.err, HasSubstr("--seed: 3-1 is reversed; allowed: 1-3")) << verb[0];
  }
  ASSERT_EQ(run({"simulate", "room.yaml", "--seed", "2-3,7", "-q"}, {}, folder.path()).code, 0);
  for (const char* seed : {"2", "3", "7"}) EXPECT_TRUE(fs::exists(folder / "out/room/recordings/room" / seed));
  EXPECT_FALSE(fs::exists(folder / "out/room/recordings/room/1"));
}

}  // namespace
}  // namespace scanbench::app_test
