// NPY files: bytes of the format, exact doubles, and refused files.
#include "harness/io/files/npy.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "core/error.hpp"
#include "tests/support/runs.hpp"

namespace scanbench::io {
namespace {

// The format by hand (NumPy enhancement proposal 1): magic, version, length of the header, header, values.
std::string by_hand(const std::string& dictionary, const std::string& data) {
  std::string header = dictionary;
  header.resize(117, ' ');
  header += '\n';
  return std::string("\x93NUMPY\x01\x00", 8) + std::string("\x76\x00", 2) + header + data;  // 0x76 = 118
}

TEST(Npy, WritesTheBytesThatTheFormatPrescribes) {
  const std::vector<std::int32_t> values{1, -1};
  const std::string expected = by_hand("{'descr': '<i4', 'fortran_order': False, 'shape': (1, 2), }",
                                       std::string("\1\0\0\0\xff\xff\xff\xff", 8));
  EXPECT_EQ(npy_bytes(values, 1, 2), expected);
}

TEST(Npy, ReadsAFileWrittenByHandWithOtherSpacing) {
  const auto array = parse_npy_int32(
      by_hand("{'shape':(2,1),'fortran_order':False,'descr':'<i4'}", std::string("\1\0\0\0\xff\xff\xff\xff", 8)), "f");
  EXPECT_EQ(array.rows, 2u);
  EXPECT_EQ(array.columns, 1u);
  EXPECT_THAT(array.values, ::testing::ElementsAre(1, -1));
}

TEST(Npy, GivesBackEveryBitOfEveryDouble) {
  const std::vector<double> values{
      -0.0, std::numeric_limits<double>::quiet_NaN(), 5e-324, std::numeric_limits<double>::infinity(), 0.1, -1e308};
  const auto array = parse_npy_float64(npy_bytes(values, 3, 2), "f");
  EXPECT_EQ(array.rows, 3u);
  EXPECT_EQ(fixtures::bits(array.values), fixtures::bits(values));
  EXPECT_EQ(parse_npy_float64(npy_bytes(std::span<const double>{}, 0, 7), "f").columns, 7u);
}

TEST(Npy, RefusesWhatItCannotReadWithTheFileAndTheFinding) {
  const auto message = [](const std::string& bytes) -> std::string {
    try {
      parse_npy_float64(bytes, "x/ranges.npy");
    } catch (const ConfigError& e) {
      return e.what();
    }
    return "accepted";
  };
  const std::string eight(8, '\0');
  using ::testing::AllOf;
  using ::testing::HasSubstr;
  EXPECT_THAT(message(""), HasSubstr("x/ranges.npy"));
  EXPECT_THAT(message(by_hand("{'descr': '<f4', 'fortran_order': False, 'shape': (1, 1), }", eight)),
              AllOf(HasSubstr("<f4"), HasSubstr("<f8")));
  EXPECT_THAT(message(by_hand("{'descr': '|O', 'fortran_order': False, 'shape': (1, 1), }", eight)), HasSubstr("|O"));
  EXPECT_THAT(message(by_hand("{'descr': '<f8', 'fortran_order': True, 'shape': (1, 1), }", eight)),
              HasSubstr("fortran_order is True"));
  for (const char* shape : {"(1,)", "()", "(1, 1, 1)", "(-1, -1)", "(1, x)", "(2, 1)", "(1, 0)",
                            "(4294967296, 4294967297)", "(9223372036854775807, 9223372036854775807)"})
    EXPECT_THAT(
        message(by_hand("{'descr': '<f8', 'fortran_order': False, 'shape': " + std::string(shape) + ", }", eight)),
        HasSubstr("shape"))
        << shape;
  const std::string whole = npy_bytes(std::vector<double>{1, 2}, 1, 2);
  for (std::size_t n = 0; n < whole.size(); ++n) EXPECT_NE(message(whole.substr(0, n)), "accepted") << n;
  EXPECT_NE(message(whole + "x"), "accepted");
}

}  // namespace
}  // namespace scanbench::io
