// Encodes and decodes frames.
#include "harness/study/foreign/frame.hpp"

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "core/error.hpp"
#include "core/number_text.hpp"
#include "harness/io/files/json.hpp"
#include "harness/study/foreign/fault.hpp"

namespace scanbench::study {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are sent as they are in memory");

constexpr char kMagic[] = {'S', 'B', 'F', '1'};

/// Bytes as text for a message: what a program that prints into the protocol has printed.
std::string printable(std::span<const char> bytes) {
  std::string text;
  for (const char c : bytes) text += c >= ' ' && c <= '~' ? c : '?';
  return text;
}

/// Throws for lists and objects that are nested too deeply: whoever prints or frees them does so recursively.
void check_nesting(std::string_view json) {
  int depth = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (in_string && c == '\\')
      ++i;
    else if (c == '"')
      in_string = !in_string;
    else if (!in_string && (c == '[' || c == '{') && ++depth > kDeepestNesting)
      throw ForeignFault("sent JSON that is nested more than " + std::to_string(kDeepestNesting) + " deep");
    else if (!in_string && (c == ']' || c == '}'))
      --depth;
  }
}

}  // namespace

nlohmann::json parsed_foreign_json(std::string_view text) {
  check_nesting(text);
  return io::parsed_json(text);
}

std::array<char, kFrameHead> encode_head(const FrameHead& head) {
  std::array<char, kFrameHead> bytes{};
  std::memcpy(bytes.data(), kMagic, sizeof kMagic);
  std::memcpy(bytes.data() + 4, &head.header_bytes, sizeof head.header_bytes);
  std::memcpy(bytes.data() + 8, &head.numbers, sizeof head.numbers);
  return bytes;
}

FrameHead decode_head(std::span<const char, kFrameHead> bytes) {
  if (std::memcmp(bytes.data(), kMagic, sizeof kMagic) != 0)
    throw ForeignFault("sent '" + printable(bytes) + "' instead of a frame; frames begin with SBF1");
  FrameHead head;
  std::memcpy(&head.header_bytes, bytes.data() + 4, sizeof head.header_bytes);
  std::memcpy(&head.numbers, bytes.data() + 8, sizeof head.numbers);
  if (head.header_bytes > kLongestHeader)
    throw ForeignFault("announces a header of " + std::to_string(head.header_bytes) + " bytes; allowed: up to " +
                       std::to_string(kLongestHeader));
  if (head.numbers > kMostNumbers)
    throw ForeignFault("announces " + std::to_string(head.numbers) + " numbers; allowed: up to " +
                       std::to_string(kMostNumbers));
  return head;
}

Answer::Answer(std::string_view header, std::vector<double> numbers)
    : header_(parsed_foreign_json(header)), numbers_(std::move(numbers)) {
  if (!header_.is_object()) throw ForeignFault("sent a header that is no JSON object");
  std::size_t used = 0;
  const auto arrays = header_.find("arrays");
  if (arrays != header_.end()) {
    if (!arrays->is_array()) throw ForeignFault("sent a header whose `arrays` is not a list");
    for (const auto& entry : *arrays) {
      const bool good = entry.is_array() && entry.size() == 2 && entry[0].is_string() && entry[1].is_number_unsigned();
      if (!good) throw ForeignFault("sent an array that is not [name, length]");
      const auto length = entry[1].get<std::uint64_t>();
      if (length > numbers_.size() - used)
        throw ForeignFault("sent arrays that are longer than the " + std::to_string(numbers_.size()) +
                           " numbers of the frame");
      arrays_[entry[0].get<std::string>()] = std::span(numbers_).subspan(used, length);
      used += length;
    }
  }
  if (used != numbers_.size())
    throw ForeignFault("sent " + std::to_string(numbers_.size()) + " numbers, of which arrays name " +
                       std::to_string(used));
}

std::span<const double> Answer::array(const std::string& name) const {
  const auto found = arrays_.find(name);
  if (found == arrays_.end()) throw InvalidResult("the answer has no array `" + name + "`");
  return found->second;
}

std::span<const double> Answer::rows(const std::string& name, std::size_t columns) const {
  const std::span<const double> all = array(name);
  if (all.size() % columns != 0)
    throw InvalidResult("the array `" + name + "` has " + std::to_string(all.size()) +
                        " numbers; allowed: " + std::to_string(columns) + " per row");
  return all;
}

std::vector<int> Answer::integers(const std::string& name) const {
  std::vector<int> result;
  const std::span<const double> numbers = array(name);
  result.reserve(numbers.size());
  for (const double number : numbers) result.push_back(whole(number, name));
  return result;
}

std::string Answer::text(const std::string& key) const {
  const auto found = header_.find(key);
  if (found == header_.end()) return "";
  if (!found->is_string()) throw InvalidResult("`" + key + "` of the answer is not a text");
  return found->get<std::string>();
}

int whole(double number, std::string_view what) {
  // Not std::floor(), which is a call of a function on a processor without SSE 4.1, and an answer has thousands.
  const bool in_range = std::fabs(number) <= std::numeric_limits<int>::max();
  const int result = in_range ? static_cast<int>(number) : 0;
  if (!in_range || static_cast<double>(result) != number)
    throw InvalidResult("a number of `" + std::string(what) + "` is " + number_text(number) +
                        "; allowed: whole numbers");
  return result;
}

}  // namespace scanbench::study
