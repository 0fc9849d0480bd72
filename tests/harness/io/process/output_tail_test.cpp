// The end of an output, as messages show it.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "harness/io/process/output_tail.hpp"

namespace scanbench::io {
namespace {

TEST(OutputTail, OfAShortOutputIsTheOutput) {
  for (const std::string text : {"", "a", "a\n", "a\n\nb", "\n", "a\nb\n"}) EXPECT_EQ(output_tail(text), text);
}

TEST(OutputTail, HasTheLastLines) {
  std::string text, expected;
  for (int i = 0; i < 100; ++i) {
    text += std::to_string(i) + "\n";
    if (i >= 80) expected += std::to_string(i) + "\n";
  }
  EXPECT_EQ(output_tail(text), expected);
  text.pop_back();
  expected.pop_back();
  EXPECT_EQ(output_tail(text), expected);
}

TEST(OutputTail, SaysHowMuchOfALongLineIsLeftOut) {
  EXPECT_EQ(output_tail("before\n" + std::string(1000, 'x') + "\nafter"),
            "before\n" + std::string(150, 'x') + " [700 bytes left out] " + std::string(150, 'x') + "\nafter");
  EXPECT_EQ(output_tail(std::string(300, 'x')), std::string(300, 'x'));
}

TEST(OutputTail, CutsNoCharacter) {
  std::string text = "a";  // so that the cuts would be within characters of two bytes
  for (int i = 0; i < 500; ++i) text += "\u00e9";
  const std::string shown = output_tail(text);
  EXPECT_TRUE(shown.starts_with("a\u00e9"));
  for (std::size_t i = 0; i < shown.size(); ++i)
    if (shown[i] == '\xc3') {
      EXPECT_EQ(shown[i + 1], '\xa9') << i;
    }
  EXPECT_EQ(std::ranges::count(shown, '\xc3'), std::ranges::count(shown, '\xa9'));
}

}  // namespace
}  // namespace scanbench::io
