// The styles of methods: visible on white paper, and different for colour-blind readers as well.
#include "render/palette.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>
#include <string>
#include <tuple>

#include <Eigen/Core>

#include "core/modules.hpp"
#include "core/registry.hpp"

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

std::vector<std::string> some_names(int count) {
  std::vector<std::string> names;
  for (int i = 0; i < count; ++i) names.push_back("method_" + std::to_string(i));
  return names;
}

std::vector<Color> all_colors() {
  std::vector<Color> colors;
  for (const std::string& name : some_names(500))
    if (const Color color = method_style(name).color; std::ranges::find(colors, color) == colors.end())
      colors.push_back(color);
  return colors;
}

TEST(Methods, CanBeSeenOnWhite) {
  for (const Color color : all_colors())
    EXPECT_GT(contrast_to_white(color), 2.2) << int{color.r} << " " << int{color.g} << " " << int{color.b};
}

// A difference of 2.3 in CIE 1976 can just be noticed side by side; thin lines far from each other need several times
// that.
TEST(Methods, HaveColoursThatColourBlindReadersCanDistinguish) {
  const std::vector<Color> colors = all_colors();
  ASSERT_EQ(colors.size(), 7U);
  for (const Eigen::Matrix3d& seen : sights())
    for (std::size_t i = 0; i < colors.size(); ++i)
      for (std::size_t k = 0; k < i; ++k)
        EXPECT_GT((lab(seen * linear(colors[i])) - lab(seen * linear(colors[k]))).norm(), 15.0) << i << " " << k;
}

TEST(Methods, LookAlikeInEveryFigure) {
  const std::vector<std::string> names = Registry<LineExtractor>::names(), some{names[7], names[3]};
  const std::vector<MethodStyle> all = method_styles(names), two = method_styles(some);
  for (std::size_t i = 0; i < names.size(); ++i) EXPECT_EQ(all[i], method_style(names[i])) << names[i];
  EXPECT_EQ(two[0], all[7]);
  EXPECT_EQ(two[1], all[3]);
}

TEST(Methods, OfOneFigureDifferAndTheirOrderDoesNotMatter) {
  std::vector<std::string> names = some_names(150);  // more than enough for two with the same look by name
  const std::vector<MethodStyle> forwards = method_styles(names);
  std::set<std::tuple<int, int, int, Dash, Marker>> looks;
  for (const auto& [color, dash, marker] : forwards)
    EXPECT_TRUE(looks.emplace(color.r, color.g, color.b, dash, marker).second);
  std::ranges::reverse(names);
  std::vector<MethodStyle> backwards = method_styles(names);
  std::ranges::reverse(backwards);
  EXPECT_EQ(backwards, forwards);
}

TEST(Methods, OfAFigureOfUpToSevenHaveDifferentColours) {
  const auto colors_of = [](const std::vector<std::string>& names) {
    std::set<std::tuple<int, int, int>> colors;
    for (const auto& [color, dash, marker] : method_styles(names)) colors.emplace(color.r, color.g, color.b);
    return colors.size();
  };
  const std::vector<std::string> collide{"no_alignment", "navigation_map"};
  EXPECT_EQ(method_style(collide[0]).color, method_style(collide[1]).color);
  EXPECT_EQ(colors_of(collide), 2U);
  EXPECT_EQ(method_styles(collide)[1], method_style(collide[1]));  // the first in the alphabet keeps its look
  const std::vector<std::string> many = some_names(70);
  for (std::size_t first = 0; first < many.size(); first += 7)
    EXPECT_EQ(colors_of({many.begin() + static_cast<std::ptrdiff_t>(first),
                         many.begin() + static_cast<std::ptrdiff_t>(first) + 7}),
              7U);
}

TEST(Methods, ThatShareNoColourLookAsTheirNamesSay) {
  const std::vector<std::string> names = some_names(60);
  std::vector<std::string> apart;
  for (const std::string& name : names)
    if (std::ranges::none_of(apart, [&](const auto& a) { return method_style(a).color == method_style(name).color; }))
      apart.push_back(name);
  ASSERT_EQ(apart.size(), 7U);
  const std::vector<MethodStyle> styles = method_styles(apart);
  for (std::size_t i = 0; i < apart.size(); ++i) EXPECT_EQ(styles[i], method_style(apart[i])) << apart[i];
}

// A dozen methods cannot have a colour each.
TEST(Methods, ThatComeWithTheProgramUseAllColours) {
  std::set<std::tuple<int, int, int>> colors;
  for (const std::string& name : Registry<LineExtractor>::names()) {
    const Color color = method_style(name).color;
    colors.emplace(color.r, color.g, color.b);
  }
  EXPECT_EQ(colors.size(), all_colors().size());
}

}  // namespace
}  // namespace scanbench::render
