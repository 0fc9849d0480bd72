// PNG and vector files of one panel: size, pixels, and equal bytes.
#include <gtest/gtest.h>

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <thread>

#include "core/error.hpp"
#include "decoded_png.hpp"
#include "render/backends/cairo.hpp"
#include "render/backends/gl.hpp"
#include "render/layout/layout.hpp"
#include "render/palette.hpp"

namespace scanbench::render {
namespace {

constexpr Color kRed{255, 0, 0};

Scene rich_scene() {
  Scene scene{.width_in = 4.0, .title = "title <&> \u03c3", .scale_bar = true};
  Panel map{.title = "map"};
  map.items = {Lines{.segments = {{{0, 0}, {4, 0}}, {{4, 0}, {4, 3}}}, .stroke = {kBlack, 1.2, Dash::solid}},
               Polyline{.points = {{0, 0}, {1, 1}, {2, 0.5}}, .stroke = {kBlue, 0.8, Dash::dash_dot}, .closed = true},
               Points{.points = {{1, 2}, {2, 2}}, .marker = Marker::triangle, .size_pt = 5, .filled = false},
               Polygon{.points = {{3, 1}, {3.5, 1}, {3.2, 2}}},
               Ellipse{.center = {1, 2.5}, .semi_axes = {0.5, 0.2}, .angle_rad = 0.4},
               Text{.at = {2, 2}, .text = "A"},
               Arrow{.pose = Pose2(2, 1, 1)}};
  Panel chart{.title = "chart",
              .x = {.label = "threshold [m]", .log = true},
              .y = {.label = "error [cm]"},
              .equal_aspect = false};
  chart.items = {Polyline{.points = {{0.01, 3}, {0.1, 1}, {1, 8}}, .stroke = {kVermillion, 1, Dash::dashed}},
                 Points{.points = {{0.01, 3}, {0.1, 1}, {1, 8}}, .marker = Marker::square, .size_pt = 4},
                 ErrorBars{.intervals = {{0.1, 0.5, 2}}}};
  scene.panels = {map, chart};
  scene.legend = {{.text = "walls", .stroke = Stroke{}}, {.text = "points", .marker = Marker::triangle}};
  return scene;
}

using test::decode_png;
using test::DecodedPng;

bool is_reddish(const Color& c) {
  return c.r > c.g + 40;
}

TEST(Png, HasTheRequestedSize) {
  Scene scene = rich_scene();
  scene.height_in = 2.5;
  const DecodedPng image = decode_png(to_png(scene, 120));
  EXPECT_EQ(image.width, 480);
  EXPECT_EQ(image.height, 300);
}

TEST(Png, ShowsARedSegmentWhereTheAxesSayAndNowhereElse) {
  Scene scene;
  scene.panels.push_back({.items = {Lines{.segments = {{{1, 1}, {4, 3}}}, .stroke = {kRed, 2.0, Dash::solid}}}});
  scene.panels[0].x.range = {0, 5};
  scene.panels[0].y.range = {0, 5};
  const double dpi = 144;
  const DecodedPng image = decode_png(to_png(scene, dpi));
  const PanelLayout place = layout(scene).panels[0];
  for (const double t : {0.0, 0.25, 0.5, 0.75, 1.0}) {
    const Vec2 px = place.to_device({1 + 3 * t, 1 + 2 * t}) * (dpi / 72);
    EXPECT_EQ(image.at(static_cast<int>(px.x()), static_cast<int>(px.y())), kRed) << t;
  }
  const Segment segment{place.to_device({1, 1}) * (dpi / 72), place.to_device({4, 3}) * (dpi / 72)};
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      if (is_reddish(image.at(x, y))) {
        EXPECT_LT(distance({x + 0.5, y + 0.5}, segment), 2.0 + 1.5) << x << " " << y;
      }
}

TEST(Png, DrawsNothingOfThePanelOutsideItsBox) {
  Scene scene;
  Panel panel{
      .items = {Lines{.segments = {{{-9, -9}, {9, 9}}, {{-9, 2}, {9, 2}}}, .stroke = {kRed, 6, Dash::solid}},
                Points{.points = {{0, 0}, {4, 2}, {4.05, 1}}, .marker = Marker::circle, .color = kRed, .size_pt = 20},
                Polygon{.points = {{-50, -50}, {50, -50}, {0, 0.5}}, .fill = kRed},
                Ellipse{.center = {2, 2}, .semi_axes = {3, 3}, .stroke = {kRed, 4, Dash::dashed}}}};
  panel.x.range = {0, 4};
  panel.y.range = {0, 4};
  scene.panels.push_back(panel);
  const double scale = 100.0 / 72;
  const DecodedPng image = decode_png(to_png(scene, 100));
  const Rect box = layout(scene).panels[0].box;
  int red = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      if (is_reddish(image.at(x, y))) {
        ++red;
        EXPECT_TRUE(x + 1 > box.x0 * scale - 0.5 && x < box.x1 * scale + 0.5 && y + 1 > box.y0 * scale - 0.5 &&
                    y < box.y1 * scale + 0.5)
            << x << " " << y;
      }
  EXPECT_GT(red, 1000);
}

// A label that cannot move, with its white rim, on a wall: the wall is still black from end to end.
TEST(Png, ShowsAllOfAWallUnderALabel) {
  Scene scene;
  scene.panels.push_back({.items = {Lines{.segments = {{{0.5, 2}, {3.5, 2}}}, .stroke = {kBlack, 1.5, Dash::solid}},
                                    Text{.at = {2, 2}, .text = "wall 7", .offset_pt = {0, 0}, .movable = false}}});
  scene.panels[0].x = {.range = std::pair{0.0, 4.0}, .grid = false};
  scene.panels[0].y = {.range = std::pair{0.0, 4.0}, .grid = false};
  const DecodedPng image = decode_png(to_png(scene, 288));
  const PanelLayout place = layout(scene).panels[0];
  const Vec2 a = place.to_device({0.6, 2}) * 4.0, b = place.to_device({3.4, 2}) * 4.0;
  for (int x = static_cast<int>(a.x()); x < static_cast<int>(b.x()); ++x)
    ASSERT_EQ(image.at(x, static_cast<int>(a.y())), kBlack) << x;
}

TEST(Png, FillsAnEllipseOfTheRightArea) {
  Scene scene;
  scene.panels.push_back({.items = {Ellipse{.center = {2, 2},
                                            .semi_axes = {1.5, 0.5},
                                            .angle_rad = 0.5,
                                            .stroke = {kRed, 0.01, Dash::solid},
                                            .fill = kRed}}});
  scene.panels[0].x = {.range = std::pair{0.0, 4.0}, .grid = false};
  scene.panels[0].y = {.range = std::pair{0.0, 4.0}, .grid = false};
  const DecodedPng image = decode_png(to_png(scene, 200));
  double area = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      if (const Color c = image.at(x, y); c.r > c.g) area += (255.0 - c.g) / 255.0;
  const PanelLayout place = layout(scene).panels[0];
  const double px_per_m = (place.to_device({1, 0}) - place.to_device({0, 0})).norm() * 200 / 72;
  EXPECT_NEAR(area / (px_per_m * px_per_m), kPi * 1.5 * 0.5, 0.02);
}

TEST(Files, AreEqualToTheByteWhenMadeAgainInThreadsAndInAnotherProcess) {
  const Scene scene = rich_scene();
  const std::string png = to_png(scene), svg = to_svg(scene), pdf = to_pdf(scene);
  EXPECT_EQ(png, to_png(scene));
  EXPECT_EQ(svg, to_svg(scene));
  EXPECT_EQ(pdf, to_pdf(scene));
  std::array<std::string, 6> made;
  {
    std::vector<std::thread> threads;
    for (std::size_t i = 0; i < 2; ++i)
      threads.emplace_back([&, i] {
        made[3 * i] = to_png(scene);
        made[3 * i + 1] = to_svg(scene);
        made[3 * i + 2] = to_pdf(scene);
      });
    for (std::thread& t : threads) t.join();
  }
  for (std::size_t i = 0; i < 6; i += 3) {
    EXPECT_EQ(made[i], png);
    EXPECT_EQ(made[i + 1], svg);
    EXPECT_EQ(made[i + 2], pdf);
  }
  const pid_t child = fork();
  if (child == 0) _exit(to_png(scene) == png && to_svg(scene) == svg && to_pdf(scene) == pdf ? 0 : 1);
  int status = -1;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_EQ(status, 0);
}

/// Checks nesting, quoting and the single root of an XML document; enough for files without comments and CDATA.
void expect_well_formed(const std::string& xml) {
  std::vector<std::string> open;
  int roots = 0;
  for (std::size_t i = 0; i < xml.size();) {
    if (xml[i] != '<') {
      ASSERT_NE(xml[i], '>') << i;
      ++i;
      continue;
    }
    const std::size_t end = xml.find('>', i);
    ASSERT_NE(end, std::string::npos);
    const std::string tag = xml.substr(i + 1, end - i - 1);
    ASSERT_EQ(tag.find('<'), std::string::npos);
    ASSERT_EQ(std::count(tag.begin(), tag.end(), '"') % 2, 0) << tag;
    if (tag[0] == '/') {
      ASSERT_FALSE(open.empty());
      ASSERT_EQ(open.back(), tag.substr(1));
      open.pop_back();
    } else if (tag[0] != '?' && tag.back() != '/') {
      if (open.empty()) ++roots;
      open.push_back(tag.substr(0, tag.find_first_of(" \n")));
    }
    i = end + 1;
  }
  EXPECT_TRUE(open.empty());
  EXPECT_EQ(roots, 1);
}

TEST(Svg, IsWellFormedAndItsReferencesStayInTheFile) {
  const std::string svg = to_svg(rich_scene());
  expect_well_formed(svg);
  std::size_t references = 0;
  for (const std::string intro : {"href=\"#", "url(#"})
    for (std::size_t at = svg.find(intro); at != std::string::npos; at = svg.find(intro, at + 1), ++references) {
      const std::size_t start = at + intro.size();
      const std::string id = svg.substr(start, svg.find_first_of("\")&", start) - start);
      EXPECT_NE(svg.find("id=\"" + id + "\""), std::string::npos) << id;
    }
  EXPECT_GT(references, 20u);
}

TEST(Svg, CanBeSearchedAndReadAloudThoughItsLettersAreOutlines) {
  Scene scene = rich_scene();
  scene.title = "walls & <lines>, \xff";
  const std::string svg = to_svg(scene, "a caption");
  expect_well_formed(svg);
  EXPECT_NE(svg.find("<title>walls &amp; &lt;lines&gt;, \uFFFD</title>"), std::string::npos);
  EXPECT_NE(svg.find("<desc>a caption</desc>"), std::string::npos);
  const auto layer = svg.find("<g fill-opacity=\"0\"");
  ASSERT_NE(layer, std::string::npos);
  EXPECT_EQ(svg.find("<text"), svg.find("<text", layer)) << "letters are outlines: they look the same everywhere";
  for (const Shape& shape : layout(scene).shapes)
    if (const auto* text = std::get_if<TextShape>(&shape.what); text != nullptr && text->text != scene.title) {
      EXPECT_NE(svg.find(">" + text->text + "</text>", layer), std::string::npos) << text->text;
    }
}

TEST(Svg, IdsOfDifferentScenesDiffer) {
  Scene other = rich_scene();
  other.title = "another";
  const auto first_id = [](const std::string& svg) { return svg.substr(svg.find("id=\"") + 4, 9); };
  EXPECT_NE(first_id(to_svg(rich_scene())), first_id(to_svg(other)));
}

TEST(Files, OfEmptyAndNonFiniteScenesAreStillWritten) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  Scene odd;
  odd.panels.push_back({.items = {Lines{.segments = {{{kNan, kNan}, {1, 1}}}}, Points{.points = {{kNan, 0}}},
                                  Polygon{.points = {{kNan, 0}}}, Text{.at = {0, kNan}, .text = "x"}}});
  odd.panels[0].x.range = {kNan, kNan};
  for (const Scene& scene : {Scene{}, odd}) {
    const DecodedPng image = decode_png(to_png(scene));
    EXPECT_EQ(image.width, 1050);  // 88.9 mm at 300 dpi
    expect_well_formed(to_svg(scene));
    EXPECT_TRUE(to_pdf(scene).starts_with("%PDF-"));
  }
}

TEST(Png, RefusesASizeThatNoPictureHas) {
  EXPECT_THROW(to_png(Scene{}, 0), ConfigError);
  EXPECT_THROW(to_png(Scene{}, 1e9), ConfigError);
  EXPECT_THROW(to_png(Scene{}, std::numeric_limits<double>::quiet_NaN()), ConfigError);
}

}  // namespace
}  // namespace scanbench::render
