// Layout of a panel: scales, axis labels, scale bar and clipped lines.
#include "render/layout/layout.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/rng.hpp"
#include "render/layout/labels.hpp"
#include "render/layout/shown_unit.hpp"
#include "render/paper/fill_triangles.hpp"
#include "render/paper/font.hpp"

namespace scanbench::render {
namespace {

Scene one_panel(std::vector<Item> items) {
  Scene scene;
  scene.panels.push_back({.title = "panel", .items = std::move(items)});
  return scene;
}

template <class T>
std::vector<const T*> shapes_of(const Layout& placed, int clip) {
  std::vector<const T*> found;
  for (const Shape& shape : placed.shapes)
    if (const T* s = std::get_if<T>(&shape.what); s != nullptr && shape.clip == clip) found.push_back(s);
  return found;
}

TEST(Layout, MakesAMetreAsLongInXAsInY) {
  const Scene scene = one_panel({Lines{.segments = {{{0, 0}, {10, 3}}}}});
  const Layout placed = layout(scene);
  const PanelLayout& p = placed.panels[0];
  const Vec2 o = p.to_device({0, 0}), x = p.to_device({1, 0}), y = p.to_device({0, 1});
  EXPECT_NEAR(x.x() - o.x(), o.y() - y.y(), 1e-9);
  EXPECT_NEAR(x.y(), o.y(), 1e-9);
  EXPECT_GT(x.x(), o.x());
  for (const Vec2& corner : {Vec2(0, 0), Vec2(10, 3)}) EXPECT_TRUE(p.box.contains(p.to_device(corner)));
}

TEST(Layout, MapsTheRangeToTheBoxOnFreeAndLogAxes) {
  Scene scene = one_panel({});
  scene.panels[0].equal_aspect = false;
  scene.panels[0].x.range = {2, 6};
  scene.panels[0].y.range = {0.01, 100};
  scene.panels[0].y.log = true;
  const PanelLayout p = layout(scene).panels[0];
  EXPECT_NEAR((p.to_device({2, 0.01}) - Vec2(p.box.x0, p.box.y1)).norm(), 0, 1e-9);
  EXPECT_NEAR((p.to_device({6, 100}) - Vec2(p.box.x1, p.box.y0)).norm(), 0, 1e-9);
  EXPECT_NEAR((p.to_device({4, 1}) - 0.5 * Vec2(p.box.x0 + p.box.x1, p.box.y0 + p.box.y1)).norm(), 0, 1e-9);
}

TEST(Layout, KeepsEveryTextOnTheCanvas) {
  Scene scene = one_panel({Lines{.segments = {{{0, 0}, {10000, 13000}}}}});
  scene.title = "a title that is much too long for a single column of a paper, which its author should know";
  scene.panels[0].title = scene.title;
  scene.panels[0].y.label = scene.title;
  scene.legend = {{.text = scene.title, .stroke = Stroke{}}, {.text = "b", .marker = Marker::square}};
  scene.panels.push_back(scene.panels[0]);
  scene.scale_bar = true;
  for (const bool share : {false, true}) {
    scene.share_axes = share;
    const Layout placed = layout(scene);
    for (const Shape& shape : placed.shapes)
      if (const auto* text = std::get_if<TextShape>(&shape.what)) {
        const double length = Font::get().width_em(text->text) * text->size;
        const Vec2 end = text->origin + (text->upwards ? Vec2(0, -length) : Vec2(length, 0));
        const Rect canvas{0, 0, placed.width, placed.height};
        EXPECT_TRUE(canvas.contains(text->origin) && canvas.contains(end)) << text->text;
        EXPECT_GE(text->origin.y() - (text->upwards ? 0 : 0.73 * text->size), 0) << text->text;
      }
  }
}

TEST(Layout, AnyExtentKeepsItsAxisLabelsAndHasTwoGridLinesEachWay) {
  // Ticks determine the width of their labels, labels the width of the boxes, and boxes the ticks.
  CounterRng rng(11, RngStream::range);
  for (int i = 0; i < 4000; ++i) {
    const double width = std::pow(10.0, 3.0 * rng.uniform());
    const double height = width * (0.4 + rng.uniform());
    const Vec2 low(-width * rng.uniform(), -height * rng.uniform());
    Scene scene = one_panel({Lines{.segments = {{low, low + Vec2(width, height)}}}});
    scene.width_in = kDoubleColumnIn;
    scene.panels[0].x.label = scene.panels[0].y.label = "y [m]";
    scene.panels.resize(3, scene.panels[0]);
    scene.columns = 1 + i % 3;
    scene.share_axes = true;
    const bool map = i % 4 != 0;
    for (Panel& panel : scene.panels) panel.equal_aspect = map;
    const Layout placed = layout(scene);
    for (const PanelLayout& p : placed.panels) {
      EXPECT_GE(p.x_ticks.size(), 2u) << "extent " << width << " x " << height << " from " << low.transpose();
      EXPECT_GE(p.y_ticks.size(), 2u) << "extent " << width << " x " << height << " from " << low.transpose();
    }
    for (const TextShape* text : shapes_of<TextShape>(placed, -1))
      if (text->upwards) {
        EXPECT_GE(text->origin.x() - 0.73 * text->size, 0.0) << "extent " << width << " x " << height;
      }
  }
}

TEST(Layout, ScaleBarIsARoundNumberOfMetresLongOnPaper) {
  Scene scene = one_panel({Lines{.segments = {{{0, 0}, {14, 13}}}}});
  scene.scale_bar = true;
  const Layout placed = layout(scene);
  const PanelLayout& p = placed.panels[0];
  EXPECT_EQ(placed.scale_bar_m, 2.0);  // a sixth of some 15 m
  EXPECT_NEAR(placed.scale_bar_pt, p.to_device({2, 0}).x() - p.to_device({0, 0}).x(), 1e-9);
  bool drawn = false;
  for (const StrokeShape* s : shapes_of<StrokeShape>(placed, -1))
    for (std::size_t k = 0; k < s->paths(); ++k)
      drawn = drawn ||
              std::abs((s->points[s->starts[k + 1] - 1] - s->points[s->starts[k]]).norm() - placed.scale_bar_pt) < 1e-9;
  EXPECT_TRUE(drawn);
}

TEST(Layout, CutsLinesAtTheBoxAndLeavesOutWhatIsNotFinite) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInf = std::numeric_limits<double>::infinity();
  Scene scene = one_panel(
      {Lines{.segments = {{{-1e6, 1}, {1e6, 1}}, {{kNan, 0}, {1, 1}}, {{0, 0}, {kInf, 1}}, {{50, 50}, {60, 60}}}},
       Polyline{.points = {{0, 0}, {1, 1}, {kNan, 1}, {2, 2}, {3, 3}, {1e300, -1e300}}},
       Points{.points = {{kNan, 1}, {kInf, 2}, {1, -kInf}, {100, 100}, {2, 3}}},
       Polygon{.points = {{0, 0}, {kNan, 1}, {2, 0}, {1, 1}}}, Ellipse{.center = {kNan, 0}},
       Text{.at = {kInf, 0}, .text = "lost"}, Arrow{.pose = Pose2(kNan, 0, 0)}, Bars{.tops = {{kNan, 1}, {1, kInf}}},
       ErrorBars{.intervals = {{1, kNan, 2}}}});
  scene.panels[0].x.range = {0, 4};
  scene.panels[0].y.range = {0, 4};
  const Layout placed = layout(scene);
  const Rect box = placed.panels[0].box;
  const double tolerance = 1.0;  // half a line's width
  std::size_t points = 0;
  for (const StrokeShape* s : shapes_of<StrokeShape>(placed, 0))
    for (const Vec2& p : s->points) {
      ++points;
      EXPECT_TRUE(p.x() >= box.x0 - tolerance && p.x() <= box.x1 + tolerance && p.y() >= box.y0 - tolerance &&
                  p.y() <= box.y1 + tolerance);
    }
  EXPECT_EQ(points, 2u + 2u + 2u);  // the long line, cut, and two pieces of the polyline
  const auto dots = shapes_of<DotsShape>(placed, 0);
  ASSERT_EQ(dots.size(), 1u);
  EXPECT_EQ(dots[0]->centers.size(), 1u);
  EXPECT_TRUE(shapes_of<TextShape>(placed, 0).empty());
}

TEST(Layout, OfAnEmptySceneAndOfEmptyPanelsIsFinite) {
  for (const Scene& scene : {Scene{}, one_panel({}), one_panel({Lines{}, Points{}, Text{}})}) {
    const Layout placed = layout(scene);
    EXPECT_GT(placed.width, 0);
    EXPECT_GT(placed.height, 0);
    EXPECT_LT(placed.height, 2000);
  }
}

TEST(Layout, KeepsARequestedHeight) {
  Scene scene = one_panel({Lines{.segments = {{{0, 0}, {1, 30}}}}});
  scene.height_in = 3.0;
  EXPECT_DOUBLE_EQ(layout(scene).height, 216.0);
  scene.height_in = 0.0;
  EXPECT_LE(layout(scene).height, 72 * scene.max_height_in + 1e-6);
}

TEST(ErrorBars, ThatLeaveThePanelEndInAnArrowAtItsEdge) {
  for (const bool log : {false, true}) {
    Scene scene = one_panel({ErrorBars{.intervals = {{1, 0.5, 0.9}, {2, -1, 2}, {3, 0.5, 7}}}});
    scene.panels[0].equal_aspect = false;
    scene.panels[0].x.range = {0, 4};
    scene.panels[0].y = {.range = std::pair(0.1, 1.0), .log = log};
    const Layout placed = layout(scene);
    const Rect box = placed.panels[0].box;
    std::vector<Vec2> tips;
    for (const FillShape* fill : shapes_of<FillShape>(placed, 0))
      for (std::size_t k = 0; k + 1 < fill->starts.size(); ++k) tips.push_back(fill->points[fill->starts[k]]);
    ASSERT_EQ(tips.size(), 3U);
    const auto x = [&](double v) { return placed.panels[0].to_device({v, 0.5}).x(); };
    EXPECT_NEAR((tips[0] - Vec2(x(2), box.y1)).norm(), 0.0, 1.0);
    EXPECT_NEAR((tips[1] - Vec2(x(2), box.y0)).norm(), 0.0, 1.0);
    EXPECT_NEAR((tips[2] - Vec2(x(3), box.y0)).norm(), 0.0, 1.0);
    // The bar that starts below a logarithmic axis is still drawn up to its edge.
    double lowest = box.y0;
    for (const StrokeShape* bars : shapes_of<StrokeShape>(placed, 0))
      for (const Vec2& p : bars->points)
        if (std::abs(p.x() - x(2)) < 0.1) lowest = std::max(lowest, p.y());
    EXPECT_GE(lowest, box.y1);
  }
}

TEST(ErrorBars, ThatEndAtTheFrameHaveACapBesideIt) {
  Scene scene = one_panel({ErrorBars{.intervals = {{1, 0.0, 1.0}}}});
  scene.panels[0].equal_aspect = false;
  scene.panels[0].x.range = {0, 2};
  scene.panels[0].y.range = {0, 1};
  const Layout placed = layout(scene);
  const Rect box = placed.panels[0].box;
  std::vector<double> caps;
  for (const StrokeShape* bars : shapes_of<StrokeShape>(placed, 0))
    for (std::size_t k = 0; k + 1 < bars->points.size(); ++k)
      if (bars->points[k].y() == bars->points[k + 1].y()) caps.push_back(bars->points[k].y());
  ASSERT_EQ(caps.size(), 2U);
  for (const double y : caps) EXPECT_GE(std::min(y - box.y0, box.y1 - y), 0.9);
}

TEST(Layout, OfARaggedGridKeepsTheSpacingOfItsRowsAndPutsTheLegendIntoTheFreeCells) {
  Scene scene = one_panel({Lines{.segments = {{{0, 0}, {10, 8}}}}});
  scene.panels.resize(7, scene.panels[0]);
  scene.columns = 3;
  scene.width_in = kDoubleColumnIn;
  scene.share_axes = true;
  scene.legend = {{.text = "walls", .stroke = Stroke{}}, {.text = "points", .marker = Marker::dot}};
  const Layout placed = layout(scene);
  const auto& p = placed.panels;
  EXPECT_NEAR(p[3].box.y0 - p[0].box.y0, p[6].box.y0 - p[3].box.y0, 1e-9);
  std::size_t found = 0;
  for (const TextShape* text : shapes_of<TextShape>(placed, -1))
    if (text->text == "walls" || text->text == "points") {
      ++found;
      EXPECT_GT(text->origin.x(), p[6].box.x1);
      EXPECT_GT(text->origin.y(), p[3].box.y1);
      EXPECT_LT(text->origin.y(), placed.height);
    }
  EXPECT_EQ(found, 2U);
  EXPECT_LT(placed.height - p[6].box.y1, 40.0) << "nothing but the axis is below the last row";
}

TEST(Layout, WrapsLongTitlesAndLosesNoWord) {
  Scene scene = one_panel({Lines{.segments = {{{0, 0}, {10, 8}}}}});
  scene.title = "a title of a figure that does not fit in the single line that a column of a paper has";
  scene.panels[0].title = "a title of a panel that does not fit in one line above it either";
  const Layout placed = layout(scene);
  std::string all;
  for (const TextShape* text : shapes_of<TextShape>(placed, -1)) {
    all += text->text + " ";
    if (!text->upwards) {
      EXPECT_LE(text->origin.x() + Font::get().width_em(text->text) * text->size, placed.width);
    }
  }
  EXPECT_NE(all.find(scene.title), std::string::npos) << all;
  EXPECT_NE(all.find(scene.panels[0].title), std::string::npos) << all;
}

std::string texts_of(const Layout& placed) {
  std::string all;
  for (const TextShape* text : shapes_of<TextShape>(placed, -1)) all += text->text + " ";
  return all;
}

TEST(Layout, CutsNoLabelInAColumnOf84Millimetres) {
  Scene scene = one_panel({Lines{.segments = {{{0, 0}, {10, 8}}}}});
  scene.width_in = 84 / 25.4;
  scene.columns = 2;
  scene.panels[0].equal_aspect = false;
  scene.panels[0].x.label = "largest angle between two merged lines";
  scene.panels[0].y.label = "walls that the map covers within 5 cm";
  scene.panels[0].x.unit = "deg";
  scene.panels.push_back(scene.panels[0]);
  scene.legend = {
      {.text = "a name that is as long as those of five methods, which all have the same lines in this scan",
       .stroke = Stroke{}}};
  const Layout placed = layout(scene);
  const std::string all = texts_of(placed);
  EXPECT_EQ(all.find("\u2026"), std::string::npos) << all;
  for (const std::string& wanted : {scene.panels[0].x.label + " [°]", scene.legend[0].text})
    EXPECT_NE(all.find(wanted), std::string::npos) << all;
  const Rect canvas{0, 0, placed.width, placed.height};
  for (const TextShape* text : shapes_of<TextShape>(placed, -1)) {
    const double length = Font::get().width_em(text->text) * text->size;
    const Vec2 end = text->origin + (text->upwards ? Vec2(0, -length) : Vec2(length, 0));
    EXPECT_TRUE(canvas.contains(text->origin) && canvas.contains(end)) << text->text;
  }
}

TEST(Layout, WritesMillimetresWhereMetresWouldHaveThreeZeros) {
  Scene scene = one_panel({Polyline{.points = {{1, 0.0005}, {2, 0.004}}}});
  scene.panels[0].equal_aspect = false;
  scene.panels[0].y = {.label = "position error", .unit = "m"};
  const Layout small = layout(scene);
  EXPECT_NE(texts_of(small).find("position error [mm]"), std::string::npos) << texts_of(small);
  for (const Tick& tick : small.panels[0].y_ticks) EXPECT_NEAR(tick.value, 1e-3 * std::stod(tick.label), 1e-12);
  scene.panels[0].items = {Polyline{.points = {{1, 0.5}, {2, 4}}}};
  const Layout large = layout(scene);
  EXPECT_NE(texts_of(large).find("position error [m]"), std::string::npos) << texts_of(large);
  for (const Tick& tick : large.panels[0].y_ticks) EXPECT_NEAR(tick.value, std::stod(tick.label), 1e-12);
}

TEST(ShownUnit, IsTheLargestInWhichATimeReachesOne) {
  EXPECT_EQ(shown_unit("us", 0, 9800, false).text, "ms");
  EXPECT_NEAR(9800 * shown_unit("us", 0, 9800, false).per_data, 9.8, 1e-12);
  EXPECT_EQ(shown_unit("us", 0, 980, false).text, "µs");
  EXPECT_EQ(shown_unit("ms", 0, 2500, false).text, "s");
  EXPECT_EQ(shown_unit("s", 1e-6, 1e-4, true).text, "µs") << "10 µs are the middle of the decades";
  EXPECT_EQ(shown_unit("deg", 0, 1, false).text, "°");
  EXPECT_EQ(shown_unit("", 0, 1, false).text, "");
  EXPECT_EQ(with_unit("F1", ""), "F1");
}

TEST(Layout, TickLabelsOfNeighbouringPanelsDoNotTouch) {
  Scene scene = one_panel({Polyline{.points = {{0, 1}, {3, 2}}}});
  scene.width_in = kDoubleColumnIn;
  scene.share_axes = true;
  scene.panels[0].equal_aspect = false;
  scene.panels[0].x = {.label = "start error", .range = std::pair(0.0, 3.0)};
  scene.panels[0].x.ticks = {{0, "10/1.5"}, {1, "20/3"}, {2, "40/6"}, {3, "80/12"}};
  scene.panels.resize(8, scene.panels[0]);
  scene.columns = 4;
  const Layout placed = layout(scene);
  std::map<double, std::vector<std::pair<double, double>>> rows;  // ends of the labels, by their height
  for (const TextShape* text : shapes_of<TextShape>(placed, -1))
    if (text->text.find('/') != std::string::npos)
      rows[text->origin.y()].emplace_back(text->origin.x(),
                                          text->origin.x() + Font::get().width_em(text->text) * text->size);
  ASSERT_EQ(rows.size(), 1u);
  auto& labels = rows.begin()->second;
  std::sort(labels.begin(), labels.end());
  ASSERT_GE(labels.size(), 8u);
  for (std::size_t k = 1; k < labels.size(); ++k)
    EXPECT_GE(labels[k].first - labels[k - 1].second, 0.2 * scene.font_pt) << "label " << k;
}

TEST(Layout, BreaksATitleIntoLinesOfAboutEqualWidth) {
  // A greedy break leaves "lines" alone in the second line.
  const double width = Font::get().width_em("a_method, median: 54") + 0.1;
  EXPECT_EQ(wrap_text("a_method, median: 54 lines", width, 3),
            (std::vector<std::string>{"a_method,", "median: 54 lines"}));
  EXPECT_EQ(wrap_text("in one line", 100, 3), std::vector<std::string>{"in one line"});
  EXPECT_TRUE(wrap_text("one two three four five six", 2, 2).back().ends_with("\u2026")) << "still shortened";
}

TEST(Layout, SaysHowManyPointsAreOutsideOfAPanel) {
  for (const int stray : {0, 1, 2}) {
    std::vector<Vec2> points{{1, 1}, {2, 2}};
    for (int i = 0; i < stray; ++i) points.emplace_back(50.0 + i, 50.0);
    Scene scene = one_panel({Points{.points = points}});
    scene.panels[0].x.range = scene.panels[0].y.range = {0, 3};
    scene.panels[0].tell_outside = "point";
    std::set<std::string> notes;  // a halo repeats its text
    const Layout placed = layout(scene);
    for (const int clip : {-1, 0})
      for (const TextShape* text : shapes_of<TextShape>(placed, clip))
        if (text->text.ends_with("outside")) notes.insert(text->text);
    if (stray == 0)
      EXPECT_TRUE(notes.empty());
    else
      EXPECT_EQ(notes, (std::set<std::string>{stray == 1 ? "1 point outside" : "2 points outside"}));
  }
}

TEST(Labels, DoNotCoverEachOtherWhereThereIsRoom) {
  std::vector<Text> texts(6, Text{.text = "label", .offset_pt = {0, 3}});
  std::vector<Label> labels;
  for (std::size_t i = 0; i < texts.size(); ++i)
    labels.push_back({&texts[i], Vec2(100.0 + 2.0 * static_cast<double>(i), 100.0)});
  const Rect box{0, 0, 200, 200};
  const std::vector<Rect> rects = place_labels(labels, 8, box, {}, {});
  for (std::size_t i = 0; i < rects.size(); ++i) {
    EXPECT_TRUE(box.contains({rects[i].x0, rects[i].y0}) && box.contains({rects[i].x1, rects[i].y1}));
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_FALSE(rects[i].x0 < rects[j].x1 && rects[j].x0 < rects[i].x1 && rects[i].y0 < rects[j].y1 &&
                   rects[j].y0 < rects[i].y1)
          << i << " covers " << j;
  }
}

TEST(Labels, TheLineToALabelRunsThroughNoOtherLabel) {
  // Walls above, below and beside the point make its label move away; straight above them is another one.
  std::vector<Vec2> walls;
  for (const double y : {93.0, 96.0, 98.0, 102.0, 104.0, 107.0}) walls.insert(walls.end(), {Vec2(40, y), Vec2(160, y)});
  const Text other{.text = "12", .offset_pt = {0, 0}, .movable = false}, own{.text = "wall", .offset_pt = {0, 3}};
  const std::vector<Label> labels{{&other, {100, 88.7}}, {&own, {100, 100}}};
  const std::vector<Rect> rects = place_labels(labels, 8, Rect{40, 0, 160, 108}, walls, {});
  EXPECT_FALSE(leader_of(labels[0], rects[0]));
  const auto leader = leader_of(labels[1], rects[1]);
  ASSERT_TRUE(leader);
  Vec2 a = leader->a, b = leader->b;
  EXPECT_FALSE(cut(a, b, rects[0]));
}

TEST(FillTriangles, CoverTheAreaOfAPolygonWithAHole) {
  const std::vector<std::vector<Vec2>> contours{{{0, 0}, {4, 0}, {5, 3}, {0, 4}}, {{1, 1}, {1, 2}, {2, 2}, {2, 1}}};
  double area = 0;
  const std::vector<Vec2> t = fill_triangles(contours, true);
  for (std::size_t i = 0; i < t.size(); i += 3) area += 0.5 * std::abs(cross(t[i + 1] - t[i], t[i + 2] - t[i]));
  EXPECT_NEAR(area, 16.0 - 1.0, 1e-12);  // shoelace: (0 + 12 + 20 + 0) / 2 = 16
}

TEST(Font, MeasuresTextAndShortensWhatIsTooLong) {
  const Font& font = Font::get();
  EXPECT_NEAR(font.width_em("AB"), font.width_em("A") + font.width_em("B"), 1e-12);
  EXPECT_EQ(fit_text("short", 100), "short");
  const std::string cut = fit_text("\u03c3\u03c1 a long text \u03c3\u03c3\u03c3", 4);
  EXPECT_LE(font.width_em(cut), 4);
  EXPECT_TRUE(cut.ends_with("\u2026"));
  EXPECT_EQ(font.shape("\xff\xc3").size(), 2u);  // malformed bytes, one mark each
}

}  // namespace
}  // namespace scanbench::render
