// Tables as terminal text, Markdown and HTML.
#include "harness/results/document/table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scanbench::results {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

Table example() {
  Table table;
  table.id = "t";
  table.title = "Lines <of> a & b";
  table.row_heads = {"line"};
  table.columns = {{"N", "lt", false}, {"N", "LT (paper)", true}, {"eta", "lt", false}};
  table.rows = {{{"1"}, {{"1.25", true, false}, {"1.28", false, true}, {"0.9", false, false}}, false},
                {{"10"}, {{"11.50", false, false}, {"", false, true}, {"–", false, false}}, false}};
  return table;
}

TEST(TerminalTable, AlignsNumbersToTheRightUnderTheirHeads) {
  EXPECT_EQ(to_terminal(example(), false),
            "Lines <of> a & b\n"
            "      N                   eta\n"
            "line     lt  LT (paper)    lt\n"
            "1     1.25*        1.28   0.9\n"
            "10    11.50                 –\n");
}

TEST(PartsOfWidth, KeepGroupsTogetherAndLoseNoColumn) {
  const auto parts = parts_of_width(example(), 30);
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_EQ(parts[0].columns.size(), 2u);
  EXPECT_EQ(parts[1].columns.size(), 1u);
  EXPECT_EQ(parts[1].rows[0].cells[0].text, "0.9");
  EXPECT_EQ(parts[1].rows[0].heads, example().rows[0].heads);
  EXPECT_EQ(parts_of_width(example(), 200).size(), 1u);
}

TEST(TerminalTable, UsesNoEscapesWithoutColour) {
  EXPECT_THAT(to_terminal(example(), false), Not(HasSubstr("\x1b")));
  EXPECT_THAT(to_terminal(example(), true), HasSubstr("\x1b[1m"));
}

TEST(MarkdownTable, HasARulerAndMarksTheBest) {
  EXPECT_THAT(to_markdown(example()), HasSubstr("| 1 | **1.25** | 1.28 | 0.9 |"));
  EXPECT_THAT(to_markdown(example()), HasSubstr("|---|---:|---:|---:|"));
}

TEST(Captions, NameTheMarkThatTheTableHas) {
  Table table = example();
  table.caption = "Means; * marks the best value.";
  EXPECT_THAT(to_terminal(table, false), HasSubstr("Means; * marks the best value."));
  EXPECT_THAT(to_markdown(table), HasSubstr("Means; bold marks the best value."));
  EXPECT_THAT(to_html(table), HasSubstr("Means; * marks the best value."));
}

TEST(HtmlTable, PutsTheCellsOfOneColumnBesideEachOther) {
  Table table{"t", "maze", "", {"pipeline"}, {{"", "maze"}}, {{{"a<b"}, {{.text = "= same", .link = "x.html"}}}}};
  table.side_by_side = true;
  EXPECT_THAT(to_html(table), HasSubstr("<a class=\"chip \" href=\"x.html\"><b>a&lt;b</b>= same<small></small></a>"));
  EXPECT_THAT(to_html(table), Not(HasSubstr("<table>")));
  EXPECT_THAT(to_markdown(table), HasSubstr("| a&lt;b | = same |"));
}

TEST(HtmlTable, OfMoreThanThePagesWidthHasParts) {
  Table table = example();
  table.page_width = 30;
  const std::string html = to_html(table);
  EXPECT_NE(html.find("<table>"), html.rfind("<table>"));
}

TEST(HtmlTable, EscapesWhatHtmlReserves) {
  EXPECT_THAT(to_html(example()), HasSubstr("Lines &lt;of&gt; a &amp; b"));
  EXPECT_THAT(to_html(example()), HasSubstr("colspan=\"2\">N</th>"));
}

}  // namespace
}  // namespace scanbench::results
