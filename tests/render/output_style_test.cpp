// Sizes and colours of figures on paper, slides and a dark ground.
#include "render/output_style.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <variant>

#include "core/error.hpp"
#include "render/layout/dark.hpp"
#include "render/layout/layout.hpp"
#include "render/palette.hpp"

namespace scanbench::render {
namespace {

Scene four_panels() {
  Scene scene{.width_in = kDoubleColumnIn, .title = "title", .columns = 4};
  for (int i = 0; i < 4; ++i) {
    Panel panel;
    panel.items = {Lines{.segments = {{{0, 0}, {1, 1}}}, .stroke = {kBlue, 1.0, Dash::solid}}};
    scene.panels.push_back(panel);
  }
  return scene;
}

TEST(OutputStyle, ThatAsksForNothingChangesNothing) {
  const Layout before = layout(four_panels()), after = layout(styled(four_panels(), {}));
  EXPECT_EQ(before.width, after.width);
  EXPECT_EQ(before.height, after.height);
  EXPECT_EQ(before.shapes.size(), after.shapes.size());
}

TEST(OutputStyle, OfAColumnHasItsWidthAndFewerPanelsInARow) {
  const Scene scene = styled(four_panels(), {.width_mm = 84});
  EXPECT_NEAR(layout(scene).width, 84 / 25.4 * 72, 1e-9);
  EXPECT_EQ(scene.columns, 2);  // 238 pt hold two panels of 104 pt, not three
  EXPECT_EQ(styled(four_panels(), {.width_mm = 181}).columns, 4);
}

TEST(OutputStyle, OfSlidesHasLargerLettersWiderLinesAndTheHeightOfASlide) {
  Scene tall;
  Panel panel;
  panel.items = {Lines{.segments = {{{0, 0}, {1, 9}}}, .stroke = {kBlue, 1.0, Dash::solid}}};
  tall.panels = {panel};
  const Scene scene = styled(tall, {.theme = Theme::slides});
  EXPECT_EQ(scene.font_pt, 14.0);
  EXPECT_GT(std::get<Lines>(scene.panels[0].items[0]).stroke.width_pt, 1.5);
  EXPECT_LE(layout(scene).height, 6.3 * 72 + 1e-6);
}

TEST(OutputStyle, WithoutATitleHasNone) {
  const Layout with = layout(four_panels()), without = layout(styled(four_panels(), {.title = false}));
  EXPECT_LT(without.height, with.height);
}

TEST(OutputStyle, UnknownThemesAreRefused) {
  EXPECT_THROW(theme_from("drak"), ConfigError);
}

TEST(Dark, KeepsTheOrderOfChannelsAndTurnsLightnessOver) {
  EXPECT_EQ(dark_color(kWhite), kDarkGround);
  const Color ink = dark_color(kBlack);
  EXPECT_GT(std::min({ink.r, ink.g, ink.b}), 220);
  for (const Color& color : {kBlue, kVermillion, kGreen, kPurple, kOrange, kSky}) {
    const Color turned = dark_color(color);
    EXPECT_EQ(color.r > color.g, turned.r > turned.g);
    EXPECT_EQ(color.g > color.b, turned.g > turned.b);
    EXPECT_EQ(color.r > color.b, turned.r > turned.b);
  }
}

/// Relative luminance of WCAG 2.
double luminance(const Color& c) {
  const auto linear = [](double v) { return v <= 0.03928 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); };
  return 0.2126 * linear(c.r / 255.0) + 0.7152 * linear(c.g / 255.0) + 0.0722 * linear(c.b / 255.0);
}

TEST(Dark, ColoursOfMethodsCanBeSeenOnTheGround) {
  for (const Color& color : {kBlue, kVermillion, kGreen, kPurple, kOrange, kSky, kBlack}) {
    const double contrast = (luminance(dark_color(color)) + 0.05) / (luminance(kDarkGround) + 0.05);
    EXPECT_GT(contrast, 3.0) << int{color.r} << " " << int{color.g} << " " << int{color.b};
  }
}

TEST(Dark, NoShapeOfAFigureKeepsTheWhiteOfPaper) {
  Scene scene = four_panels();
  scene.panels[0].items.emplace_back(
      Points{.points = {{0.5, 0.5}}, .marker = Marker::circle, .size_pt = 5, .filled = false});
  scene.panels[0].items.emplace_back(Text{.at = {0.2, 0.2}, .text = "A"});
  scene.dark = true;
  const Layout placed = layout(scene);
  const auto is_white = [](const Color& c) { return c == kWhite; };
  for (const Shape& shape : placed.shapes) {
    if (const auto* fill = std::get_if<FillShape>(&shape.what)) {
      EXPECT_FALSE(is_white(fill->color));
    }
    if (const auto* dots = std::get_if<DotsShape>(&shape.what)) {
      EXPECT_FALSE(is_white(dots->color));
    }
    if (const auto* text = std::get_if<TextShape>(&shape.what)) {
      EXPECT_FALSE(is_white(text->halo_color));
    }
  }
  const auto* ground = std::get_if<FillShape>(&placed.shapes.front().what);
  ASSERT_NE(ground, nullptr);
  EXPECT_EQ(ground->color, kDarkGround);
}

TEST(Styled, GivesAPanelWithLettersOfItsOwnTheirRoomToo) {
  Scene scene{.width_in = kDoubleColumnIn, .panels = std::vector<Panel>(2), .columns = 2};
  EXPECT_EQ(styled(scene, {.width_mm = 84}).columns, 2);
  scene.panels[1].room = {.left = 6.0, .right = 2.0};
  EXPECT_EQ(styled(scene, {.width_mm = 84}).columns, 1);
  EXPECT_EQ(styled(scene, {.width_mm = 180}).columns, 2);
}

}  // namespace
}  // namespace scanbench::render
