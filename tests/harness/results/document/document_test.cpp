// Documents as HTML, Markdown and text for a terminal.
#include "harness/results/document/document.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/results/document/html_page.hpp"

namespace scanbench::results {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// Every kind of block.
Document everything() {
  Table table{"t", "Values", "", {"name"}, {{"", "f1"}}, {{{"iepf"}, {{"0.9"}}}}};
  return {
      "A <title>",
      {Heading{2, "Part", "part"},
       Paragraph{{bold("Good."), " a & b, ", code("x --y"), " ", link("there", "there.html", "a hint")}, "faint"},
       Paragraph{"Items:"}, BulletList{{"one", "two"}}, Definitions{{{"f1", "the <mean>"}}}, std::move(table),
       Picture{.alt = "a map", .caption = "The map.", .address = "map.png"},
       Picture{.alt = "none", .caption = "Nothing to draw."}, ContentLinks{{{"part", "Part"}}}, Markup{"<svg></svg>"},
       Fold{"which", {Paragraph{"folded"}}}, BlockGroup{"pair", {Paragraph{"grouped"}}, "both"}}};
}

TEST(Document, IsWrittenAsMarkdownWithAnEmptyLineBetweenBlocks) {
  EXPECT_EQ(to_markdown(everything()),
            "# A &lt;title&gt;\n\n"
            "## Part\n\n"
            "**Good.** a &amp; b, `x --y` [there](there.html)\n\n"
            "Items:\n\n"
            "- one\n- two\n\n"
            "- f1: the &lt;mean&gt;\n\n"
            "### Values\n\n| name | f1 |\n|---|---:|\n| iepf | 0.9 |\n\n"
            "![a map](map.png)\n\nThe map.\n\n"
            "Nothing to draw.\n\n"
            "which:\n\nfolded\n\n"
            "grouped\n");
}

TEST(Document, IsWrittenForATerminalWithoutMarks) {
  EXPECT_EQ(to_terminal(everything(), false),
            "Part\n\n"
            "Good. a & b, x --y there\n\n"
            "Items:\n"
            "  one\n  two\n\n"
            "  f1: the <mean>\n\n"
            "Values\nname   f1\niepf  0.9\n\n"
            "The map.\n\n"
            "Nothing to draw.\n\n"
            "which:\n\nfolded\n\n"
            "grouped\n");
}

TEST(Document, IsWrittenAsHtmlBlockByBlock) {
  const std::string page = to_html(everything());
  EXPECT_THAT(page,
              AllOf(HasSubstr("<title>A &lt;title&gt; – scanbench</title>"), HasSubstr("<h2 id=\"part\">Part</h2>"),
                    HasSubstr("<p class=\"faint\"><b>Good.</b> a &amp; b, <code>x --y</code> "
                              "<a href=\"there.html\" title=\"a hint\">there</a></p>")));
  EXPECT_THAT(page, AllOf(HasSubstr("<ul>\n<li>one</li>\n<li>two</li>\n</ul>"),
                          HasSubstr("<dt>f1</dt><dd>the &lt;mean&gt;</dd>"), HasSubstr("<table>")));
  EXPECT_THAT(page, AllOf(HasSubstr("src=\"map.png\"><figcaption>The map.</figcaption></figure>"),
                          HasSubstr("<p class=\"faint\">Nothing to draw.</p>"),
                          HasSubstr("<nav><a href=\"#part\">Part</a></nav>"), HasSubstr("<svg></svg>")));
  EXPECT_THAT(page, AllOf(HasSubstr("<details><summary>which</summary>\n<p>folded</p>\n</details>"),
                          HasSubstr("<div class=\"pair\" id=\"both\">\n<p>grouped</p>\n</div>")));
}

TEST(Document, LetsNoTextBecomeMarkup) {
  const std::string hostile = "<script>alert(1)</script>\x1b[31m ![x](http://y)";
  const Blocks blocks{Paragraph{{link(hostile, "#" + hostile, hostile)}}, Picture{.alt = hostile, .caption = hostile}};
  EXPECT_THAT(to_html(blocks), AllOf(Not(HasSubstr("<script>")), Not(HasSubstr("\x1b"))));
  EXPECT_THAT(to_markdown(blocks), AllOf(Not(HasSubstr("<script>")), Not(HasSubstr("\x1b")), HasSubstr("x\\](http")));
  EXPECT_THAT(to_terminal({"", blocks}, true), Not(HasSubstr("\x1b")));
}

TEST(Document, BeginsWithItsTitleAnAnswerAndWhenItWasMade) {
  const Document page{.title = "Room",
                      .blocks = {Paragraph{"text"}},
                      .lead = "a is <best>.",
                      .lead_style = "verdict",
                      .stamp = "2026 · seed 1"};
  EXPECT_THAT(to_html(page),
              HasSubstr("<header>\n<h1>Room</h1>\n<p class=\"lead verdict\">a is &lt;best&gt;.</p>\n"
                        "<p class=\"stamp\">2026 · seed 1</p>\n</header>\n<main>\n<p>text</p>\n</main>"));
  EXPECT_EQ(to_markdown(page), "# Room\n\na is &lt;best&gt;.\n\n2026 · seed 1\n\ntext\n");
}

TEST(Stamp, HasDateVersionAndSeeds) {
  const std::vector<std::pair<std::string, std::string>> facts{
      {"version", "0.1.0, commit 0123456789abcdef0123-dirty-77"}, {"started", "2026-11-24T10:12:33Z"}};
  const std::string made = "2026-11-24 10:12 UTC · scanbench 0.1.0, commit 0123456789ab with changes";
  EXPECT_EQ(stamp_of(facts, {}), made);
  EXPECT_EQ(stamp_of(facts, {4}), made + " · seed 4");
  EXPECT_EQ(stamp_of(facts, {3, 1, 2}), made + " · seeds 1 to 3");
  EXPECT_EQ(stamp_of({}, {1, 3, 9}), "seeds 1, 3, 9");
  EXPECT_EQ(stamp_of({}, {1, 3, 5, 7, 9, 11}), "6 seeds, 1 to 11");
}

// CommonMark: an unbalanced bracket, a blank or a parenthesis would end the text or the address of a picture.
TEST(Markdown, EscapesTheAlternativeTextAndTheAddressOfAPicture) {
  const Blocks blocks{Picture{.alt = "scans [1] of a | b](c", .caption = "It.", .address = "a (1).png"}};
  EXPECT_EQ(to_markdown(blocks), "![scans \\[1\\] of a \\| b\\](c](a%20%281%29.png)\n\nIt.\n");
}

TEST(Sections, WithoutBlocksAreLeftOutAndHaveNoLink) {
  const Blocks blocks = section_blocks({{"a", "First", {Paragraph{"text"}}}, {"b", "Second", {}}}, {{"commit", "abc"}});
  EXPECT_EQ(to_html(blocks),
            "<nav><a href=\"#a\">First</a><a href=\"#facts\">How to get these numbers again</a></nav>\n"
            "<h2 id=\"a\">First</h2>\n<p>text</p>\n"
            "<h2 id=\"facts\">How to get these numbers again</h2>\n<dl>\n<dt>commit</dt><dd>abc</dd>\n</dl>\n");
}

}  // namespace
}  // namespace scanbench::results
