// The looks of methods: they can be seen on white paper, told apart, and told apart by colour-blind readers.
#include "render/palette.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include <Eigen/Core>

namespace scanbench::render {
namespace {

/// Linear light of an sRGB colour, IEC 61966-2-1.
Eigen::Vector3d linear(Color color) {
  const auto of = [](std::uint8_t byte) {
    const double c = byte / 255.0;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  };
  return {of(color.r), of(color.g), of(color.b)};
}

/// WCAG 2.1, contrast ratio.
double contrast_to_white(Color color) {
  return 1.05 / (Eigen::Vector3d(0.2126, 0.7152, 0.0722).dot(linear(color)) + 0.05);
}

/// CIE 1976 L*a*b* of linear light, white D65.
Eigen::Vector3d lab(const Eigen::Vector3d& light) {
  Eigen::Matrix3d xyz_from_rgb;
  xyz_from_rgb << 0.4124, 0.3576, 0.1805, 0.2126, 0.7152, 0.0722, 0.0193, 0.1192, 0.9505;
  const Eigen::Vector3d xyz = xyz_from_rgb * light.cwiseMax(0.0).cwiseMin(1.0);
  const auto f = [](double t) { return t > 0.008856 ? std::cbrt(t) : 7.787 * t + 16.0 / 116.0; };
  const double x = f(xyz[0] / 0.9505), y = f(xyz[1]), z = f(xyz[2] / 1.089);
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

/// Machado, Oliveira & Fernandes, "A physiologically-based model for simulation of color vision deficiency", 2009,
/// severity 1: normal sight, protanopia, deuteranopia, tritanopia, on linear light.
std::vector<Eigen::Matrix3d> sights() {
  std::vector<Eigen::Matrix3d> all(4);
  all[0].setIdentity();
  all[1] << 0.152286, 1.052583, -0.204868, 0.114503, 0.786281, 0.099216, -0.003882, -0.048116, 1.051998;
  all[2] << 0.367322, 0.860646, -0.227968, 0.280085, 0.672501, 0.047413, -0.011820, 0.042940, 0.968881;
  all[3] << 1.255528, -0.076749, -0.178779, -0.078411, 0.930809, 0.147602, 0.004733, 0.691367, 0.303900;
  return all;
}

std::vector<Color> colors_of(std::size_t methods) {
  std::vector<Color> colors;
  for (std::size_t i = 0; i < methods; ++i)
    if (const Color color = method_style(i).color; std::ranges::find(colors, color) == colors.end())
      colors.push_back(color);
  return colors;
}

TEST(Methods, CanBeSeenOnWhite) {
  for (const Color color : colors_of(50))
    EXPECT_GT(contrast_to_white(color), 2.2) << int{color.r} << " " << int{color.g} << " " << int{color.b};
}

// A difference of 2.3 in CIE 1976 can just be noticed side by side; thin lines far from each other need several times
// that.
TEST(Methods, HaveColoursThatColourBlindReadersTellApart) {
  const std::vector<Color> colors = colors_of(50);
  ASSERT_GE(colors.size(), 7U);
  for (const Eigen::Matrix3d& seen : sights())
    for (std::size_t i = 0; i < colors.size(); ++i)
      for (std::size_t k = 0; k < i; ++k)
        EXPECT_GT((lab(seen * linear(colors[i])) - lab(seen * linear(colors[k]))).norm(), 15.0) << i << " " << k;
}

TEST(Methods, OfOneColourDifferInDashAndMarkerAndNoTwoLookAlike) {
  const std::size_t colors = colors_of(50).size();
  for (std::size_t i = 0; i < colors; ++i) {
    const MethodStyle first = method_style(i), next = method_style(i + colors);
    EXPECT_EQ(first.color, next.color);
    EXPECT_NE(first.dash, next.dash);
    EXPECT_NE(first.marker, next.marker);
  }
  std::set<std::tuple<int, int, int, Dash, Marker>> looks;
  for (std::size_t i = 0; i < 100; ++i) {
    const auto [color, dash, marker] = method_style(i);
    EXPECT_TRUE(looks.emplace(color.r, color.g, color.b, dash, marker).second) << i;
  }
}

}  // namespace
}  // namespace scanbench::render
