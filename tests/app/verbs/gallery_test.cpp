// figures CATALOGUE: all figures of a file, on one page.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/app/program.hpp"

namespace scanbench::app_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

const std::string kCatalogue = R"(schema: 1
about: two figures
figures:
  - {name: first, of: "Somebody 2000, figure 1", shows: a room, scenario: room.yaml, figure: environment}
  - name: second
    of: Somebody 2000, figure 2
    shows: lines in a <room>
    scenario: room.yaml
    figure: {name: scan_overlay, params: {frame: 2}}
absent:
  - {of: "Somebody 2000, figure 3", why: a photograph}
)";

class Gallery : public testing::Test {
 protected:
  void SetUp() override {
    folder_.write("room.yaml", room());
    folder_.write("book.yaml", kCatalogue);
  }
  Outcome here(const Args& args) const { return run(args, {}, folder_.path()); }
  /// The pictures and pages, without the run that they are drawn from.
  std::map<std::string, std::string> pages(const std::string& out) const {
    auto found = files(folder_ / out);
    std::erase_if(found, [](const auto& file) { return file.first.starts_with("run/"); });
    return found;
  }
  Folder folder_;
};

TEST_F(Gallery, HasAPictureACaptionAndACommandForEachFigureAndSaysWhatIsAbsent) {
  const auto outcome = here({"figures", "book.yaml", "--format", "png,svg,pdf"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "out/book/index.html\n");
  for (const char* file : {"first.png", "first.svg", "first.pdf", "first.caption.txt", "second.png", "gallery.md"})
    EXPECT_TRUE(fs::exists(folder_ / "out/book" / file)) << file;
  const std::string page = read(folder_ / "out/book/index.html");
  EXPECT_THAT(page, AllOf(HasSubstr("Somebody 2000, figure 1"), HasSubstr("src=\"first.png\""),
                          HasSubstr("scanbench figures book.yaml --entry second"), HasSubstr("a photograph"),
                          HasSubstr("lines in a &lt;room&gt;"), HasSubstr("the points of scan 2,")));
  EXPECT_THAT(read(folder_ / "out/book/gallery.md"), HasSubstr("![Somebody 2000, figure 1](first.png)"));
}

TEST_F(Gallery, WithPdfAloneStillShowsPicturesOnItsPage) {
  ASSERT_EQ(here({"figures", "book.yaml", "--format", "pdf", "--entry", "first", "-q"}).code, 0);
  EXPECT_TRUE(fs::exists(folder_ / "out/book/first.pdf"));
  EXPECT_THAT(read(folder_ / "out/book/index.html"), AllOf(HasSubstr("src=\"first.png\""), HasSubstr("first.pdf")));
}

TEST_F(Gallery, IsTheSameForAnyNumberOfJobsAndWhenMadeAgainFromItsOwnRun) {
  ASSERT_EQ(here({"figures", "book.yaml", "--out", "one", "-q"}).code, 0);
  ASSERT_EQ(here({"figures", "book.yaml", "--out", "two", "-q", "--jobs", "2"}).code, 0);
  const auto first = pages("one");
  EXPECT_THAT(differences(first, pages("two")), IsEmpty());
  const std::string timing = read(folder_ / "one/run/cells/room/iepf/1/status.json");
  ASSERT_EQ(here({"figures", "book.yaml", "--out", "one", "-q"}).code, 0);
  EXPECT_THAT(differences(first, pages("one")), IsEmpty());
  EXPECT_EQ(timing, read(folder_ / "one/run/cells/room/iepf/1/status.json")) << "the cell was run again";
}

TEST_F(Gallery, OfAScenarioSaysWhatFiguresTakes) {
  const auto outcome = here({"figures", "room.yaml"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("room.yaml: a scenario or suite; allowed: a run folder, which `scanbench run "
                                     "room.yaml` makes, or a catalogue of figures"));
}

TEST_F(Gallery, MakesOnlyTheNamedEntries) {
  ASSERT_EQ(here({"figures", "book.yaml", "--entry", "second", "-q", "--out", "some"}).code, 0);
  EXPECT_TRUE(fs::exists(folder_ / "some/second.png"));
  EXPECT_FALSE(fs::exists(folder_ / "some/first.png"));
  const auto wrong = here({"figures", "book.yaml", "--entry", "secnd"});
  EXPECT_EQ(wrong.code, 2);
  EXPECT_THAT(wrong.err, HasSubstr("did you mean 'second'?"));
}

TEST_F(Gallery, ThatNamesWhatDoesNotExistIsRefusedWithItsPlace) {
  std::string text = kCatalogue;
  folder_.write("book.yaml", text.replace(text.find("environment"), 11, "enviroment"));
  const auto outcome = here({"figures", "book.yaml"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("book.yaml:4:"), HasSubstr("did you mean 'environment'?")));
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

TEST_F(Gallery, LeavesAFolderThatIsNotItsOwnAlone) {
  folder_.write("thesis/chapter.txt", "years of work");
  const auto outcome = here({"figures", "book.yaml", "--out", "thesis"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("thesis: not a folder of figures"));
  EXPECT_EQ(files(folder_ / "thesis").size(), 1U);
  EXPECT_EQ(here({"figures", "book.yaml", "--frame", "2"}).code, 2);  // an entry names its scan itself
}

}  // namespace
}  // namespace scanbench::app_test
