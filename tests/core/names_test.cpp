// Lists of names, and the nearest name to a misspelt one.
#include "core/names.hpp"

#include <gtest/gtest.h>

namespace scanbench {
namespace {

using Names = std::vector<std::string>;

TEST(Join, PutsTheSeparatorBetweenWordsOnly) {
  EXPECT_EQ(join(Names{}), "");
  EXPECT_EQ(join(Names{"a"}), "a");
  EXPECT_EQ(join(Names{"a", "", "c"}), "a, , c");
  EXPECT_EQ(join(Names{"a", "b"}, " / "), "a / b");
}

TEST(NearestName, HasAtMostTwoEditsOrAThirdOfTheLength) {
  const Names known{"iepf", "sef", "line_tracking"};
  EXPECT_EQ(nearest_name("ipf", known), "iepf");                     // one insertion
  EXPECT_EQ(nearest_name("lien_tracking", known), "line_tracking");  // two substitutions
  EXPECT_EQ(nearest_name("line_trak", known), "");                   // four insertions, three allowed for nine letters
  EXPECT_EQ(nearest_name("line_tracki", known), "line_tracking");
  EXPECT_EQ(nearest_name("zzzzzz", known), "");
}

TEST(NearestName, OfEquallyNearNamesIsTheFirst) {
  EXPECT_EQ(nearest_name("b", {"ab", "bc"}), "ab");
}

TEST(KnownNames, EndsAMessage) {
  EXPECT_EQ(known_names("ipf", {"iepf", "sef"}), "; did you mean 'iepf'? known: iepf, sef");
  EXPECT_EQ(known_names("hough", {"iepf", "sef"}), "; known: iepf, sef");
  EXPECT_EQ(known_names("hough", {}), "; known: none");
}

TEST(WordsOfName, SeparateAYearAndBeginWithACapital) {
  EXPECT_EQ(words_of_name("lakaemper2009_hallway"), "Lakaemper 2009 hallway");
  EXPECT_EQ(words_of_name("four_rooms"), "Four rooms");
  EXPECT_EQ(words_of_name("borges2000"), "Borges 2000");
  EXPECT_EQ(words_of_name("log20091"), "Log20091");
  EXPECT_EQ(words_of_name("2009_room"), "2009 room");
  EXPECT_EQ(words_of_name(""), "");
}

}  // namespace
}  // namespace scanbench
