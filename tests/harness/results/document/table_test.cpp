// Tables as terminal text, Markdown and HTML.
#include "harness/results/document/table.hpp"
#include "harness/results/document/html_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>
#include <string>

namespace scanbench::results {
namespace {

using ::testing::AllOf;
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

// The page scrolls it; parts below each other would each sort for themselves.
TEST(HtmlTable, IsOneTableHoweverWide) {
  Table table{"t", "Wide", "", {"pipeline"}, {}, {{{"a"}, {}}, {{"b"}, {}}}};
  for (int c = 0; c < 60; ++c) {
    table.columns.push_back({"group " + std::to_string(c / 3), "a long head " + std::to_string(c)});
    for (auto& row : table.rows) row.cells.push_back({std::to_string(c) + ".123"});
  }
  const std::string html = to_html(table);
  EXPECT_EQ(html.find("<table>"), html.rfind("<table>"));
  EXPECT_EQ(html.find("<tbody>"), html.rfind("<tbody>"));
  EXPECT_THAT(html, HasSubstr("a long head 59"));
}

TEST(HtmlTable, SaysWhatEveryHeadIsOf) {
  const std::string html = to_html(example());
  EXPECT_THAT(html, HasSubstr("<caption><h3>Lines &lt;of&gt; a &amp; b</h3></caption>"));
  EXPECT_THAT(html, HasSubstr("<th class=\"group\" scope=\"colgroup\" colspan=\"2\">N</th>"));
  EXPECT_THAT(html, HasSubstr("<th class=\"head\" scope=\"col\">line</th>"));
  EXPECT_THAT(html, HasSubstr("<th class=\"head\" scope=\"row\">10</th>"));
  const std::regex without_scope("<th(?![a-z])(?![^>]*scope=)");
  EXPECT_FALSE(std::regex_search(html, without_scope)) << html;
}

TEST(HtmlTable, HasIntervalsBelowTheirValues) {
  Table table{"t", "", "", {"pipeline"}, {{"", "x"}, {"", "y"}, {"", "z"}, {"", "t"}}, {}};
  table.rows = {{{"a"}, {{"0.80 ± 0.03", true}, {"0.97 (0.88 to 0.99)"}, {"2 seeds (3 to 4)"}, {"0.85 ± 0.05 µs"}}}};
  EXPECT_THAT(to_html(table),
              AllOf(HasSubstr(">0.80*<small>± 0.03</small></td>"), HasSubstr(">0.97<small>(0.88 to 0.99)</small></td>"),
                    HasSubstr(">2 seeds (3 to 4)</td>"), HasSubstr(">0.85 ± 0.05 µs</td>")));
}

TEST(Heads, AreWordsOnPagesAndNamesOfMetricsOnATerminal) {
  Table table{"t", "", "", {"pipeline"}, {{"", "sigma_offset [cm]", false, "sigma_offset", "offset error [cm] ↓"}}, {}};
  table.rows = {{{"a"}, {{"0.5"}}, false, "not converged", "cells/room/a/"}};
  EXPECT_THAT(to_terminal(table, false), AllOf(HasSubstr("sigma_offset [cm]"), HasSubstr("a (not converged)")));
  EXPECT_THAT(to_markdown(table), AllOf(HasSubstr("| offset error [cm] ↓ |"), HasSubstr("| a (not converged) |")));
  EXPECT_THAT(to_html(table), AllOf(HasSubstr("title=\"sigma_offset\">offset error [cm]&nbsp;↓</th>"),
                                    HasSubstr("<a href=\"cells/room/a/\">a</a><small>not converged</small></th>")));
  table.columns = {{"sigma_offset [cm]", "iepf", false, "sigma_offset", "offset error [cm] ↓"}};
  EXPECT_THAT(to_markdown(table), HasSubstr("| offset error [cm] ↓ iepf |"));
  EXPECT_THAT(to_html(table), AllOf(HasSubstr(">offset error [cm]&nbsp;↓</th>"), HasSubstr(">iepf</th>")));
}

TEST(HtmlTable, EscapesWhatHtmlReserves) {
  EXPECT_THAT(to_html(example()), HasSubstr("Lines &lt;of&gt; a &amp; b"));
  EXPECT_THAT(to_html(example()), HasSubstr("colspan=\"2\">N</th>"));
}

}  // namespace
}  // namespace scanbench::results
