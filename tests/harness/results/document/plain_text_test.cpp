// Characters from modules and file names, and those that reach a reader.
#include "harness/results/document/plain_text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "harness/results/document/table.hpp"

namespace scanbench::results {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(PlainText, HasNoControlCharactersAndIsValidUtf8) {
  EXPECT_EQ(plain_text("\x1b[2Jcleared\a"), "?[2Jcleared?");
  EXPECT_EQ(plain_text("two\nlines\tapart"), "two\nlines apart");
  EXPECT_EQ(plain_text("höhle 5 ± 1 µs → 漢字 😀"), "höhle 5 ± 1 µs → 漢字 😀");
  EXPECT_EQ(plain_text("\xc2\x9b"
                       "31m"),
            "?31m");  // the one-character form of ESC [
  EXPECT_EQ(plain_text("a\xe2\x80\xae"
                       "b"),
            "a?b");  // right-to-left override
  EXPECT_EQ(plain_text("\xff\xc3(\xc0\x80\xed\xa0\x80"), std::string(2, '?') + "(" + std::string(5, '?'));
  EXPECT_EQ(plain_text("\xe2\x82"), std::string(2, '?'));  // truncated
}

TEST(PlainLine, IsBoundedAndCutBetweenCharacters) {
  EXPECT_EQ(plain_line("a\nb"), "a b");
  EXPECT_EQ(plain_line(std::string(600, 'x')), std::string(600, 'x'));
  const std::string cut = plain_line(std::string(10'000'000, 'x'));
  EXPECT_LT(cut.size(), 700U);
  EXPECT_THAT(cut, HasSubstr("10000000 bytes"));
  EXPECT_EQ(plain_line("aaaöbbb", 4).substr(0, 4), "aaa ");
}

TEST(MarkdownTable, LetsNoCellBecomeMarkup) {
  Table table;
  table.row_heads = {"message"};
  table.rows = {{{"a | b\n<script>alert(1)</script> ![x](http://y) **c**"}, {}, false}};
  const std::string text = to_markdown(table);
  EXPECT_THAT(text, AllOf(Not(HasSubstr("<script>")), HasSubstr("x\\](http"), HasSubstr("a \\| b &lt;script"),
                          HasSubstr("\\*\\*c")));
}

TEST(TerminalTable, PassesNoEscapesOfItsCellsOn) {
  Table table;
  table.row_heads = {"message"};
  table.rows = {{{"red \x1b[31m"}, {}, false}};
  EXPECT_THAT(to_terminal(table, false), Not(HasSubstr("\x1b")));
}

}  // namespace
}  // namespace scanbench::results
