// Oblique view: scale, parallels, depth and points.
#include "render/charts/view3.hpp"

#include <gtest/gtest.h>

#include <variant>

#include "render/layout/layout.hpp"
#include "render/output_style.hpp"
#include "render/paper/font.hpp"

namespace scanbench::render {
namespace {

View3 view(double azimuth_deg, double elevation_deg) {
  return View3({Axis3{"x [m]", -1.0, 3.0, {}}, Axis3{"y [m]", 0.0, 2.0, {}}, Axis3{"z", 0.0, 180.0, {}}},
               {.azimuth_deg = azimuth_deg, .elevation_deg = elevation_deg, .height = 0.5});
}

TEST(View3, FromStraightAboveIsAPlanWithOneScale) {
  const View3 v = view(-90, 90);  // the camera above, its lower edge on the side of small y
  const Vec2 origin = v.project({-1, 0, 0});
  EXPECT_NEAR((v.project({3, 0, 0}) - origin - Vec2(1, 0)).norm(), 0.0, 1e-12);  // the longer side is one unit
  EXPECT_NEAR((v.project({-1, 2, 0}) - origin - Vec2(0, 0.5)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((v.project({-1, 0, 180}) - origin).norm(), 0.0, 1e-12);
}

TEST(View3, FromTheSideShowsTheHeightInFull) {
  const View3 v = view(-90, 0);
  EXPECT_NEAR((v.project({0, 1, 180}) - v.project({0, 1, 0}) - Vec2(0, 0.5)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((v.project({0, 2, 90}) - v.project({0, 0, 90})).norm(), 0.0, 1e-12);
}

TEST(View3, KeepsParallelsParallel) {
  const View3 v = view(-60, 24);
  const Vec3 step(0.3, 0.2, 10.0);
  const Vec2 there = v.project(Vec3(0, 0, 0) + step) - v.project(Vec3(0, 0, 0));
  const Vec2 here = v.project(Vec3(2, 1, 90) + step) - v.project(Vec3(2, 1, 90));
  EXPECT_NEAR((there - here).norm(), 0.0, 1e-12);
}

TEST(View3, NearnessIsZeroAtTheFarthestCornerAndOneAtTheNearest) {
  const View3 v = view(-60, 24);  // from the side of large x and small y, from above
  EXPECT_NEAR(v.nearness({3, 0, 180}), 1.0, 1e-12);
  EXPECT_NEAR(v.nearness({-1, 2, 0}), 0.0, 1e-12);
  EXPECT_GT(v.nearness({1, 0.5, 90}), v.nearness({1, 1.5, 90}));
}

TEST(View3, ThePanelHoldsTheWholeBox) {
  for (const double azimuth : {-150.0, -60.0, 20.0, 120.0}) {
    const View3 v = view(azimuth, 24);
    const Panel panel = v.panel(250.0, 8.0);
    EXPECT_FALSE(panel.axes);
    for (const double x : {-1.0, 3.0})
      for (const double y : {0.0, 2.0})
        for (const double z : {0.0, 180.0}) {
          const Vec2 p = v.project({x, y, z});
          EXPECT_GT(p.x(), panel.x.range->first);
          EXPECT_LT(p.x(), panel.x.range->second);
          EXPECT_GT(p.y(), panel.y.range->first);
          EXPECT_LT(p.y(), panel.y.range->second);
        }
  }
}

TEST(View3, CutsNoLetterInAColumnOf84Millimetres) {
  for (const double width_mm : {84.0, 180.0}) {
    Scene scene;
    scene.width_in = kDoubleColumnIn;
    scene.columns = 2;
    const View3 v({Axis3{"x [m]", -3.0, 3.0, {}}, Axis3{"y [m]", -3.0, 3.0, {}},
                   Axis3{"direction [°]", 0.0, 180.0, {{0, "0"}, {90, "90"}, {180, "180 = 0"}}}},
                  {});
    scene.panels = {v.panel(257.0, scene.font_pt), v.panel(257.0, scene.font_pt)};
    const Layout placed = layout(styled(scene, {.width_mm = width_mm}));
    int texts = 0;
    for (const Shape& shape : placed.shapes)
      if (const auto* text = std::get_if<TextShape>(&shape.what); text != nullptr && shape.clip >= 0) {
        ++texts;
        const double length = Font::get().width_em(text->text) * text->size;
        const Vec2 end = text->origin + (text->upwards ? Vec2(0, -length) : Vec2(length, 0));
        const Rect& box = placed.panels[static_cast<std::size_t>(shape.clip)].box;
        EXPECT_TRUE(box.contains(text->origin) && box.contains(end)) << text->text << " of " << width_mm << " mm";
      }
    EXPECT_GT(texts, 2 * 9);
  }
}

TEST(PointsByDepth, AreAllThereFromFarToNearAndDarken) {
  const View3 v = view(-60, 24);
  const std::vector<Vec3> points{{3, 0, 180}, {-1, 2, 0}, {1, 1, 90}, {NAN, 0, 0}};
  Panel panel;
  add_points_by_depth(v, points, {.color = kBlack, .size_pt = 2.0}, panel);
  std::vector<Vec2> drawn;
  int last = 256;
  for (const Item& item : panel.items) {
    const auto& slice = std::get<Points>(item);
    EXPECT_LT(slice.color.r, last);
    last = slice.color.r;
    drawn.insert(drawn.end(), slice.points.begin(), slice.points.end());
  }
  ASSERT_EQ(drawn.size(), 3u);
  EXPECT_EQ(drawn[0], v.project(points[1]));
  EXPECT_EQ(drawn[1], v.project(points[2]));
  EXPECT_EQ(drawn[2], v.project(points[0]));
}

}  // namespace
}  // namespace scanbench::render
