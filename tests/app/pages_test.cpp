// The pages that a run can give: all have the same frame, and every link leads to a file.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <regex>
#include <string>
#include <vector>

#include "tests/app/program.hpp"

namespace scanbench::app_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// A folder with a run of two pipelines and two seeds and its player, a benchmark, a night and a gallery.
class Pages : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<Folder>();
    folder_->write("room.yaml", room_with("metrics:", "  - {name: lt, extract: {module: line_tracking}}\nmetrics:"));
    folder_->write("suite.yaml",
                   "schema: 1\nscenarios: [room.yaml]\nmetrics: [segments, {name: efficiency, params: {matches: "
                   "true}}, timing]\nbenchmark: {baseline: iepf}\nfigures: []\n");
    folder_->write("nights.yaml", "schema: 1\nscenarios: [room.yaml]\n");
    folder_->write("book.yaml",
                   "schema: 1\nfigures:\n  - {name: first, of: \"A [1]\", shows: a room, scenario: room.yaml, figure: "
                   "environment}\n");
    for (const Args& args : std::vector<Args>{{"run", "room.yaml", "--out", "run", "--seed", "1,2", "-q"},
                                              {"report", "run", "--scans"},
                                              {"run", "suite.yaml", "--out", "suite", "-q"},
                                              {"night", "run", "nights.yaml", "--store", "n.sqlite", "--out", "night"},
                                              {"figures", "book.yaml", "--out", "gallery", "-q"}}) {
      const Outcome outcome = app_test::run(args, {}, folder_->path());
      ASSERT_EQ(outcome.code, 0) << args[0] << ": " << outcome.err;
    }
  }
  static void TearDownTestSuite() { folder_.reset(); }
  static const Folder& folder() { return *folder_; }
  static std::vector<fs::path> pages() {
    return {"run/report.html",    "run/scans.html",    "suite/report.html",
            "night/nightly.html", "night/report.html", "gallery/index.html"};
  }

 private:
  inline static std::unique_ptr<Folder> folder_;
};

std::size_t count_of(const std::string& text, const std::string& word) {
  std::size_t count = 0;
  for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++count;
  return count;
}

/// The page without its data, styles and scripts.
std::string marks_of(const fs::path& page) {
  static const std::regex other("<(script|style)[^]*?</\\1>");
  return std::regex_replace(read(page), other, "");
}

TEST_F(Pages, HaveTheSameFrame) {
  std::string style;
  for (const fs::path& page : pages()) {
    const std::string text = read(folder() / page);
    const std::string own = text.substr(0, text.find("</style>"));
    const std::string sheet = own.substr(own.find("<style>"));
    if (style.empty()) style = sheet;
    EXPECT_EQ(sheet, style) << page;
    for (const char* once : {"<h1>", "<header>", "<main>", "</main>", "<p class=\"lead", "<p class=\"stamp\">"})
      EXPECT_EQ(count_of(text, once), 1U) << page << ": " << once;
    const std::size_t stamp = text.find("class=\"stamp\"");
    EXPECT_LT(text.find("<h1>"), text.find("class=\"lead"));
    EXPECT_LT(text.find("class=\"lead"), stamp);
    EXPECT_LT(stamp, text.find("<main>"));
    EXPECT_THAT(text.substr(stamp, 200), HasSubstr("scanbench 0")) << page;
  }
}

TEST_F(Pages, SayWhatEveryHeadAndFigureIs) {
  for (const fs::path& page : pages()) {
    if (page == "run/scans.html") continue;  // its table is made by its script
    const std::string text = marks_of(folder() / page);
    EXPECT_EQ(count_of(text, "<th "), count_of(text, " scope=\"")) << page;
    EXPECT_EQ(count_of(text, "<th>"), 0U) << page;
    EXPECT_EQ(count_of(text, "<figure>"), count_of(text, "<figcaption>")) << page;
  }
}

TEST_F(Pages, HaveNoLinkThatLeadsNowhere) {
  static const std::regex address("href=\"([^\"#]*)(#([^\"]*))?\"");
  for (const fs::path& page : pages()) {
    const fs::path file = folder() / page;
    const std::string text = marks_of(file);
    for (auto found = std::sregex_iterator(text.begin(), text.end(), address); found != std::sregex_iterator();
         ++found) {
      const std::string target = found->str(1), place = found->str(3);
      EXPECT_TRUE(target.empty() || fs::exists(file.parent_path() / target)) << page << ": " << target;
      if (target.empty()) {
        EXPECT_THAT(text, HasSubstr("id=\"" + place + "\"")) << page;
      }
    }
  }
}

TEST_F(Pages, OfARunLeadToItsCellsTablesPicturesAndScans) {
  const std::string text = read(folder() / "run/report.html");
  for (const char* address : {"summary.csv", "manifest.json", "scans.html", "cells/room/lt/2/", "recordings/room/",
                              "figures/room_environment.svg", "figures/room_environment.png", "scans.html#room/2"})
    EXPECT_THAT(text, HasSubstr("href=\"" + std::string(address) + "\"")) << address;
  EXPECT_THAT(read(folder() / "suite/report.html"), HasSubstr("href=\"cells/room/lt/1/\""));
}

TEST_F(Pages, HaveReadableTitlesAndSentences) {
  const std::string run = read(folder() / "run/report.html");
  EXPECT_THAT(run, AllOf(HasSubstr("<h1>Room</h1>"), HasSubstr("seeds 1 to 2"), HasSubstr("class=\"lead\">")));
  EXPECT_THAT(read(folder() / "suite/report.html"),
              AllOf(HasSubstr("<h1>Benchmark of 2 extractors</h1>"), HasSubstr("F1 against time")));
  EXPECT_THAT(read(folder() / "night/nightly.html"),
              AllOf(HasSubstr("<h1>Nights, night of 2"), HasSubstr("<p class=\"lead verdict good\">PASS")));
  EXPECT_THAT(read(folder() / "gallery/index.html"),
              AllOf(HasSubstr("1 figure and table, made."), Not(HasSubstr("dense"))))
      << "a dense grid shows later figures before earlier tables";
  EXPECT_THAT(read(folder() / "gallery/gallery.md"), HasSubstr("![A \\[1\\]](first.png)"));
}

}  // namespace
}  // namespace scanbench::app_test
