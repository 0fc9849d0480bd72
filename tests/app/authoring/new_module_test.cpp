// new: the file of a module, and what is refused. That the modules work is shown by the conformance tests, which
// compile one of each kind.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/app/program.hpp"

namespace scanbench::app_test {
namespace {

using testing::HasSubstr;

class NewModule : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_ / "algorithms"); }
  Outcome here(const Args& args) const { return run(args, {}, folder_.path()); }
  Folder folder_;
};

TEST_F(NewModule, TheExtractorIsTheOneThatTheReadmeShows) {
  const auto outcome = here({"module", "new", "extract", "my_lines"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("./scanbench test --module my_lines"));
  const std::string readme = read(places::source_dir() / "README.md");
  const auto first = readme.find("```cpp\n") + 7;
  EXPECT_EQ(read(folder_ / "algorithms/extract/my_lines.cpp"), readme.substr(first, readme.find("```", first) - first));
}

TEST_F(NewModule, TheClassOfEachKindIsNamedAfterTheModule) {
  for (const std::string kind : {"extract", "match", "align", "merge"}) {
    ASSERT_EQ(here({"module", "new", kind, "two_words"}).code, 0) << kind;
    const std::string text = read(folder_ / ("algorithms/" + kind + "/two_words.cpp"));
    EXPECT_THAT(text, testing::AllOf(HasSubstr("class TwoWords final"), HasSubstr(".name = \"two_words\""),
                                     testing::Not(HasSubstr("my_")), testing::Not(HasSubstr("My")),
                                     testing::StartsWith("// two_words: ")));
  }
}

TEST_F(NewModule, SaysThatAKindHasNoTemplate) {
  fs::create_directories(folder_ / "algorithms/map");
  const auto outcome = here({"module", "new", "map", "mine"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("there is no template for modules of the kind map; there are: extract, match, "
                                     "align, merge; begin with a copy of a file of algorithms/map"));
}

TEST_F(NewModule, RefusesWhatCannotBeAModuleAndKeepsWhatIsThere) {
  for (const std::string name : {"", "Big", "9lives", "my-lines", "a__b", "trailing_", "../x", "a b"})
    EXPECT_EQ(here({"module", "new", "extract", name}).code, 2) << name;
  EXPECT_THAT(here({"module", "new", "extrakt", "my_lines"}).err, HasSubstr("did you mean 'extract'?"));
  EXPECT_THAT(here({"module", "new", "extract", "iepf"}).err, HasSubstr("there is a module 'iepf'"));
  folder_.write("algorithms/extract/mine.cpp", "hours of work");
  EXPECT_THAT(here({"module", "new", "extract", "mine"}).err, HasSubstr("exists already"));
  EXPECT_EQ(read(folder_ / "algorithms/extract/mine.cpp"), "hours of work");
  const Folder elsewhere;
  const auto outcome = run({"module", "new", "extract", "mine"}, {}, elsewhere.path());
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("--sources"));
}

}  // namespace
}  // namespace scanbench::app_test
