// Options of a made-up program: what they set, what they refuse, and what is known of them.
#include "app/options.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"

namespace scanbench::app_test {
namespace {

using app::CommandLine;
using app::Option;
using app::Verb;
using app::Words;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

struct Values {
  std::string text = "plain", from;
  std::filesystem::path path;
  Words files, sets, names, plugins;
  int jobs = 1;
  double width = 2.5;
  std::size_t frames = 200;
  std::optional<std::uint16_t> fps;
  std::optional<std::uint64_t> seed;
  bool quiet = false;
  bool text_given = false;
};

/// The command line `prog draw ...` and the values that it set.
struct Program {
  explicit Program(Words words) : words_(std::move(words)) {
    words_.insert(words_.begin(), "prog");
    for (auto& word : words_) argv_.push_back(word.data());
    line.emplace(static_cast<int>(argv_.size()), argv_.data(), "prog", "Draws.", "The end.", "7.1");
    Verb draw = line->add_verb("draw", "Draws files");
    draw.option("FILE", values.files, "what to draw").completed_by([] { return Words{"world", "scan"}; });
    const Option text = draw.option("-t,--text", values.text, "a title").shows_default();
    draw.option("--from", values.from, "an earlier drawing");
    draw.option("--path", values.path, "where to");
    draw.option("--set", values.sets, "KEY=VALUE").repeatable();
    draw.option("--names", values.names, "names").separated_by_commas().one_of("name", {"carmen", "csv"});
    draw.option("--plugin", values.plugins, "a library").one_value_each();
    draw.option("--jobs", values.jobs, "threads").whole_number("number of threads", 1, 9);
    draw.option("--width", values.width, "width").number("width in mm", 0.5, 1e3);
    draw.option("--frames", values.frames, "frames");
    draw.option("--fps", values.fps, "frames per second").whole_number("rate", 1, 60);
    draw.option("--seed", values.seed, "a seed");
    draw.flag("-q,--quiet", values.quiet, "print nothing");
    draw.runs([this, text] {
      values.text_given = text.given();
      return 3;
    });
    draw.renamed("--paint", "`draw --paint` is now `draw --text`");
    Verb judge = line->add_verb("judge", "Judges a file");
    judge.details("By its size.");
    judge.option("FILE", values.from, "the file").required();
    judge.runs([] { return 4; });
    line->drawer("Shelf");
    Verb shelf = line->add_verb("shelf", "Keeps drawings");
    Verb put = shelf.add_verb("put", "Puts a file on it");
    put.option("FILE", values.from, "the file").required();
    put.option("--width", values.width, "width").number("age in years", 0, 9);
    put.flag("--json", values.quiet, "print JSON");
    put.runs([] { return 5; });
    shelf.add_verb("take", "Takes a file from it").runs([] { return 6; });
    line->renamed("keep", "shelf put");
  }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  std::optional<CommandLine> line;
  Values values;

 private:
  Words words_;
  std::vector<char*> argv_;
};

/// The values after `prog draw` with these arguments.
Values drawn(Words words) {
  words.insert(words.begin(), "draw");
  Program program(std::move(words));
  const std::function<int()> action = program.line->parse();
  EXPECT_EQ(action(), 3);
  return program.values;
}

std::string refusal(Words words) {
  Program program(std::move(words));
  try {
    program.line->parse();
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

TEST(Options, KeepTheirDefaultsUnlessTheyAreGiven) {
  const Values values = drawn({});
  EXPECT_EQ(values.text, "plain");
  EXPECT_FALSE(values.text_given);
  EXPECT_EQ(values.width, 2.5);
  EXPECT_EQ(values.frames, 200U);
  EXPECT_FALSE(values.fps || values.seed || values.quiet);
  EXPECT_THAT(values.files, IsEmpty());
}

TEST(Options, SetValuesOfEveryType) {
  const Values values = drawn({"a", "b", "-t", "title", "--path", "x/y", "--jobs", "9", "--width", "1e2", "--frames",
                               "7", "--fps", "60", "--seed", "18446744073709551615", "-q"});
  EXPECT_THAT(values.files, ElementsAre("a", "b"));
  EXPECT_EQ(values.text, "title");
  EXPECT_TRUE(values.text_given);
  EXPECT_EQ(values.path, std::filesystem::path("x/y"));
  EXPECT_EQ(values.jobs, 9);
  EXPECT_EQ(values.width, 100.0);
  EXPECT_EQ(values.frames, 7U);
  EXPECT_EQ(values.fps, std::uint16_t{60});
  EXPECT_EQ(values.seed, UINT64_MAX);
  EXPECT_TRUE(values.quiet);
}

TEST(Options, WithSeveralValuesTakeThemAsDeclared) {
  EXPECT_THAT(drawn({"--set", "a=1,2", "--set", "b=3"}).sets, ElementsAre("a=1,2", "b=3"));
  EXPECT_THAT(drawn({"--names", "csv,carmen"}).names, ElementsAre("csv", "carmen"));
  const Values values = drawn({"--plugin", "a.so", "file", "--plugin", "b.so"});
  EXPECT_THAT(values.plugins, ElementsAre("a.so", "b.so"));
  EXPECT_THAT(values.files, ElementsAre("file"));
}

TEST(Options, RefuseOtherValuesAndSayWhatIsAllowed) {
  for (const char* jobs : {"0", "10", "1.5", "many", ""})
    EXPECT_THAT(refusal({"draw", std::string("--jobs=") + jobs}),
                *jobs == '\0' ? HasSubstr("--jobs")
                              : HasSubstr("--jobs: '" + std::string(jobs) +
                                          "' is not a number of threads; allowed: a whole number 1 .. 9"));
  for (const char* width : {"0.4", "1001", "nan", "wide"})
    EXPECT_THAT(refusal({"draw", "--width", width}),
                HasSubstr("'" + std::string(width) + "' is not a width in mm; allowed: 0.5 .. 1000"));
  EXPECT_THAT(refusal({"draw", "--names", "csv,csw"}),
              HasSubstr("'csw' is not a name; did you mean 'csv'?; allowed: carmen, csv"));
  EXPECT_THAT(refusal({"draw", "--seed", "one"}), HasSubstr("--seed"));
}

TEST(CommandLine, NamesTheNearestVerbOrOption) {
  EXPECT_THAT(refusal({}), HasSubstr("a verb is missing; known: draw, judge, shelf"));
  EXPECT_THAT(refusal({"drwa"}), HasSubstr("there is no verb 'drwa'; did you mean 'draw'?"));
  EXPECT_THAT(refusal({"draw", "--job", "2"}), HasSubstr("'draw' has no option '--job'; did you mean '--jobs'?"));
  EXPECT_THAT(refusal({"judge"}), HasSubstr("'judge' needs FILE: the file"));
  EXPECT_THAT(refusal({"judge"}), HasSubstr("\n(scanbench --help shows the verbs"));
}

TEST(CommandLine, SaysInOneSentenceWhatAFormerNameIsNow) {
  EXPECT_EQ(refusal({"keep", "a", "--width", "3"}), "`keep` is now `shelf put`");
  EXPECT_EQ(refusal({"keep", "--help"}), "`keep` is now `shelf put`");
  EXPECT_EQ(refusal({"draw", "--paint", "x"}), "`draw --paint` is now `draw --text`");
  EXPECT_EQ(refusal({"draw", "--paint=x"}), "`draw --paint` is now `draw --text`");
  EXPECT_THAT(refusal({"judge", "--paint", "x"}), HasSubstr("'judge' has no option '--paint'"));
}

TEST(CommandLine, HasVerbsBelowVerbs) {
  Program program({"shelf", "put", "a"});
  EXPECT_EQ(program.line->parse()(), 5);
  EXPECT_EQ(program.values.from, "a");
  EXPECT_THAT(refusal({"shelf"}), HasSubstr("'shelf': a verb is missing; known: put, take"));
  EXPECT_THAT(refusal({"shelf", "putt"}), HasSubstr("'shelf': there is no verb 'putt'; did you mean 'put'?"));
  EXPECT_THAT(refusal({"shelf", "put"}), HasSubstr("'shelf put' needs FILE: the file"));
  EXPECT_THAT(refusal({"shelf", "put", "a", "--wdth", "1"}), HasSubstr("'shelf put' has no option '--wdth'; did you"));
  EXPECT_THAT(refusal({"shelf", "put", "a", "b"}), HasSubstr("'shelf put' takes no further argument 'b'"));
  EXPECT_THAT(refusal({"shelf", "put", "a", "--json", "c.json"}),
              HasSubstr("takes no further argument 'c.json'; --json has no value"));
  EXPECT_THAT(refusal({"shelf", "put", "a", "--width", "10"}), HasSubstr("'10' is not an age in years"));
}

TEST(CommandLine, RunsTheVerbThatWasChosen) {
  Program program({"judge", "a"});
  EXPECT_EQ(program.line->parse()(), 4);
  EXPECT_THAT(program.line->argv(), ElementsAre("prog", "judge", "a"));
}

TEST(CommandLine, PrintsHelpAndVersionInsteadOfAnAction) {
  for (const Words& words :
       {Words{"--help"}, Words{"--version"}, Words{"draw", "--help"}, Words{"shelf", "put", "--help"}}) {
    testing::internal::CaptureStdout();
    Program program(words);
    EXPECT_FALSE(program.line->parse());
    const std::string printed = testing::internal::GetCapturedStdout();
    if (words.front() == "--version")
      EXPECT_EQ(printed, "7.1\n");
    else
      EXPECT_THAT(printed, AllOf(HasSubstr("Usage: prog"), HasSubstr("The end.")));
  }
}

TEST(CommandLine, HelpHasItsVerbsInDrawersAndTheDetailsOfOne) {
  testing::internal::CaptureStdout();
  Program({"--help"}).line->parse();
  EXPECT_THAT(testing::internal::GetCapturedStdout(), AllOf(HasSubstr("\nShelf:\n  shelf "), HasSubstr("\n  draw ")));
  testing::internal::CaptureStdout();
  Program({"judge", "--help"}).line->parse();
  EXPECT_THAT(testing::internal::GetCapturedStdout(), AllOf(HasSubstr("By its size."), HasSubstr("The end.")));
}

TEST(CommandLine, DescribesItsVerbsAndOptions) {
  const Program program({});
  const app::ProgramDescription text = program.line->description();
  EXPECT_EQ(text.program.name, "prog");
  EXPECT_EQ(text.footer, "The end.");
  ASSERT_EQ(text.verbs.size(), 3U);
  EXPECT_EQ(text.verbs[1].help, "Judges a file");
  EXPECT_EQ(text.verbs[1].details, "By its size.");
  ASSERT_EQ(text.verbs[2].verbs.size(), 2U);
  EXPECT_EQ(text.verbs[2].verbs[0].path, "shelf put");
  const auto& options = text.verbs[0].options;
  ASSERT_EQ(options.size(), 14U);  // and --help
  EXPECT_THAT(options[0].long_names, ElementsAre("--help"));
  EXPECT_EQ(options[1].name, "FILE");
  EXPECT_THAT(options[1].long_names, IsEmpty());
  EXPECT_THAT(options[1].words(), ElementsAre("world", "scan"));
  EXPECT_THAT(options[2].short_names, ElementsAre("-t"));
  EXPECT_EQ(options[2].default_value, "plain");
  EXPECT_THAT(options[6].choices, ElementsAre("carmen", "csv"));
  EXPECT_TRUE(options[6].has_value);
  EXPECT_FALSE(options[13].has_value);
}

}  // namespace
}  // namespace scanbench::app_test
