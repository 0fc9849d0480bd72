// Pictures read back with libpng's simplified interface, for the tests of figures.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "render/scene.hpp"

namespace scanbench::render::test {

struct DecodedPng {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;

  Color at(int x, int y) const;
};

/// A picture of size 0 x 0, and a failed test, if the bytes are not a PNG file.
DecodedPng decode_png(const std::string& bytes);

}  // namespace scanbench::render::test
