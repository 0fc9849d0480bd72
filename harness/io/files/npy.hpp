// NumPy's .npy format, version 1.0 (numpy.lib.format): two-dimensional arrays of float64 and int32 in C order.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace scanbench::io {

template <class T>
struct NpyArray {
  std::size_t rows = 0;
  std::size_t columns = 0;
  std::vector<T> values;  ///< row by row
};

/// A whole .npy file, little-endian; values.size() == rows * columns.
std::string npy_bytes(std::span<const double> values, std::size_t rows, std::size_t columns);
std::string npy_bytes(std::span<const std::int32_t> values, std::size_t rows, std::size_t columns);

/// Reads the bytes of a .npy file. Throws ConfigError, naming `file`, for anything else: other types, Fortran order,
/// objects (pickle), other dimensions, a length that does not fit.
NpyArray<double> parse_npy_float64(std::string_view bytes, const std::filesystem::path& file);
NpyArray<std::int32_t> parse_npy_int32(std::string_view bytes, const std::filesystem::path& file);

}  // namespace scanbench::io
