// The test vectors of RFC 4648, section 10, and lengths around the size of a piece.
#include "harness/io/files/base64.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <string>

namespace scanbench::io {
namespace {

TEST(Base64, GivesTheTestVectorsOfTheRfc) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foob"), "Zm9vYg==");
  EXPECT_EQ(base64("fooba"), "Zm9vYmE=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
}

TEST(Base64, OfMegabytesHasPaddingAtItsEndOnly) {
  for (const std::size_t extra : {0U, 1U, 2U}) {
    const std::string text = base64(std::string((std::size_t{3} << 20) + extra, '\0'));
    EXPECT_EQ(text.size(), (std::size_t{4} << 20) + (extra > 0 ? 4 : 0));
    EXPECT_EQ(text.find_first_not_of('A'), extra == 0 ? std::string::npos : text.size() - (3 - extra));
  }
}

}  // namespace
}  // namespace scanbench::io
