// Frames of the protocol between this program and a program that is a module. docs/plugins.md has the description.
//
//   bytes 0-3    "SBF1"
//   bytes 4-7    length of the header in bytes, unsigned, little endian
//   bytes 8-15   count of the numbers that follow the header, unsigned, little endian
//   then         the header: a JSON object in UTF-8
//   then         the numbers: float64, little endian
//
// The header's key `arrays` is a list of [name, length]: how the numbers are divided.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

namespace scanbench::study {

inline constexpr int kProtocolVersion = 1;
inline constexpr std::size_t kFrameHead = 16;
inline constexpr std::uint32_t kLongestHeader = 1U << 20;
inline constexpr int kDeepestNesting = 32;               ///< of lists and objects in a header
inline constexpr std::uint64_t kMostNumbers = 1U << 23;  ///< of an answer: 64 MiB

/// The first 16 bytes of a frame.
struct FrameHead {
  std::uint32_t header_bytes = 0;
  std::uint64_t numbers = 0;
};

/// JSON that a foreign module has written. Throws ForeignFault if it is nested more than kDeepestNesting deep.
nlohmann::json parsed_foreign_json(std::string_view text);

std::array<char, kFrameHead> encode_head(const FrameHead& head);

/// Throws ForeignFault for bytes that are not a head, and for a frame that would be too large.
FrameHead decode_head(std::span<const char, kFrameHead> bytes);

/// An answer of a program.
class Answer {
 public:
  Answer() = default;
  /// Throws ForeignFault if the header is no JSON object, or if its arrays do not add up to the numbers.
  Answer(std::string_view header, std::vector<double> numbers);

  const nlohmann::json& header() const { return header_; }
  bool has(const std::string& array) const { return arrays_.contains(array); }
  /// Throws InvalidResult if there is no such array.
  std::span<const double> array(const std::string& name) const;
  /// The array as rows of `columns` numbers. Throws InvalidResult if its length is not a multiple.
  std::span<const double> rows(const std::string& name, std::size_t columns) const;
  /// The array as whole numbers. Throws InvalidResult for a number that is none.
  std::vector<int> integers(const std::string& name) const;
  /// A text of the header; empty if it is absent. Throws InvalidResult if it is something else.
  std::string text(const std::string& key) const;

 private:
  nlohmann::json header_;
  std::vector<double> numbers_;
  std::map<std::string, std::span<const double>, std::less<>> arrays_;
};

/// A number of a result as a whole number. Throws InvalidResult, with `what`, if it is none.
int whole(double number, std::string_view what);

}  // namespace scanbench::study
