// Writer and strict reader of .npy version 1.0.
#include "harness/io/files/npy.hpp"

#include <bit>
#include <cstring>
#include <optional>

#include "core/error.hpp"
#include "core/number_text.hpp"

namespace scanbench::io {
namespace {

static_assert(std::endian::native == std::endian::little, "values are copied from memory byte by byte");

constexpr std::string_view kMagic{"\x93NUMPY\x01\x00", 8};
constexpr std::size_t kPreamble = 10;  // magic, version, two bytes of header length

template <class T>
std::string encode(std::span<const T> values, std::size_t rows, std::size_t columns, std::string_view type) {
  SCANBENCH_ASSERT(values.size() == rows * columns);
  std::string header = "{'descr': '" + std::string(type) + "', 'fortran_order': False, 'shape': (" +
                       std::to_string(rows) + ", " + std::to_string(columns) + "), }";
  while ((kPreamble + header.size() + 1) % 64 != 0) header.push_back(' ');
  header.push_back('\n');
  std::string bytes(kMagic);
  bytes.push_back(static_cast<char>(header.size() & 0xff));
  bytes.push_back(static_cast<char>(header.size() >> 8));
  bytes += header;
  const std::size_t start = bytes.size();
  bytes.resize(start + values.size_bytes());
  if (!values.empty()) std::memcpy(bytes.data() + start, values.data(), values.size_bytes());
  return bytes;
}

/// The text of a key's value in the header's dictionary: up to the comma that ends it, or the whole tuple.
std::optional<std::string> value_of(std::string_view header, std::string_view key) {
  const auto at = header.find("'" + std::string(key) + "'");
  if (at == std::string_view::npos) return std::nullopt;
  auto rest = header.substr(at + key.size() + 2);
  const auto colon = rest.find_first_not_of(" :");
  if (colon == std::string_view::npos) return std::nullopt;
  rest.remove_prefix(colon);
  const auto end = rest.front() == '(' ? rest.find(')') : rest.find_first_of(",}");
  if (end == std::string_view::npos) return std::nullopt;
  std::string value;
  for (const char c : rest.substr(0, rest.front() == '(' ? end + 1 : end))
    if (c != ' ') value.push_back(c);
  return value;
}

template <class T>
NpyArray<T> decode(std::string_view bytes, std::string_view type, const std::filesystem::path& file) {
  const auto refuse = [&](const std::string& found) {
    throw ConfigError(file.string() + ": " + found + "; allowed: .npy version 1.0, type '" + std::string(type) +
                      "', C order, two dimensions");
  };
  if (bytes.size() < kPreamble || bytes.substr(0, kMagic.size()) != kMagic) refuse("not a .npy file of version 1.0");
  const std::size_t length =
      static_cast<unsigned char>(bytes[8]) + 256 * std::size_t{static_cast<unsigned char>(bytes[9])};
  if (bytes.size() - kPreamble < length) refuse("the header is cut off");
  const std::string_view header = bytes.substr(kPreamble, length);
  const auto descr = value_of(header, "descr");
  if (descr != "'" + std::string(type) + "'") refuse("the type is " + descr.value_or("missing"));
  if (const auto order = value_of(header, "fortran_order"); order != "False")
    refuse("fortran_order is " + order.value_or("missing"));
  const std::string shape = value_of(header, "shape").value_or("missing");
  const auto comma = shape.find(',');
  std::optional<long long> rows;
  std::optional<long long> columns;
  if (shape.size() > 2 && comma != std::string::npos) {
    rows = parse_integer(std::string_view(shape).substr(1, comma - 1));
    columns = parse_integer(std::string_view(shape).substr(comma + 1, shape.size() - comma - 2));
  }
  if (!rows || !columns || *rows < 0 || *columns < 0) refuse("the shape is " + shape);
  NpyArray<T> array{static_cast<std::size_t>(*rows), static_cast<std::size_t>(*columns), {}};
  const std::string_view data = bytes.substr(kPreamble + length);
  const auto expected = static_cast<__uint128_t>(array.rows) * array.columns * sizeof(T);
  if (expected != data.size())
    refuse("the shape " + shape + " does not fit the " + std::to_string(data.size()) + " bytes of data");
  array.values.resize(array.rows * array.columns);
  if (!data.empty()) std::memcpy(array.values.data(), data.data(), data.size());
  return array;
}

}  // namespace

std::string npy_bytes(std::span<const double> values, std::size_t rows, std::size_t columns) {
  return encode(values, rows, columns, "<f8");
}

std::string npy_bytes(std::span<const std::int32_t> values, std::size_t rows, std::size_t columns) {
  return encode(values, rows, columns, "<i4");
}

NpyArray<double> parse_npy_float64(std::string_view bytes, const std::filesystem::path& file) {
  return decode<double>(bytes, "<f8", file);
}

NpyArray<std::int32_t> parse_npy_int32(std::string_view bytes, const std::filesystem::path& file) {
  return decode<std::int32_t>(bytes, "<i4", file);
}

}  // namespace scanbench::io
