#include "look/dress.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

namespace navvi_rviz::look {
namespace {

using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

Marker marker(const char* ns, int type) {
  Marker msg;
  msg.ns = ns;
  msg.type = type;
  msg.pose.orientation.w = 1.0;
  msg.scale.x = msg.scale.y = msg.scale.z = 1.0;
  msg.color = color_msg({0.5F, 0.5F, 0.5F});
  return msg;
}

Marker dressed(const Marker& msg, const char* vision = "high_contrast") {
  MarkerArray array;
  array.markers = {msg};
  const MarkerArray result = dress(array, *find_vision(vision));
  EXPECT_EQ(result.markers.size(), 1U);
  return result.markers.at(0);
}

double luminance(const std_msgs::ColorRGBA& color) {
  const auto linear = [](double c) {
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  };
  return 0.2126 * linear(color.r) + 0.7152 * linear(color.g) + 0.0722 * linear(color.b);
}

double contrast(const Color& one, const Color& other) {
  const double a = luminance(color_msg(one)), b = luminance(color_msg(other));
  return (std::max(a, b) + 0.05) / (std::min(a, b) + 0.05);
}

TEST(Vision, what_surrounds_is_dark_and_each_thing_has_an_edge_that_is_seen) {
  for (const std::string& name : vision_names()) {
    const Vision& vision = *find_vision(name);
    EXPECT_GE(contrast(vision.text, vision.plate), 7.0) << name;
    EXPECT_GE(contrast(vision.bright, vision.dark), 7.0) << name;
    EXPECT_GE(contrast(vision.fill.at("path"), vision.fill.at("floor")), 7.0) << name;
    for (const char* around : {"floor", "shelf", "wall"}) {
      EXPECT_GE(contrast(vision.bright, vision.fill.at(around)), 4.5) << name << around;
      EXPECT_GE(contrast(vision.fill.at("robot"), vision.fill.at(around)), 4.5) << name << around;
      for (const char* thing : {"box", "pedestal", "other"})
        EXPECT_GE(contrast(vision.edge.at(thing), vision.fill.at(around)), 4.5)
            << name << " " << thing << " " << around;
    }
    // 3:1 as WCAG 2 asks (1.4.11): lighter, and boxes and the goal no longer stand out from them.
    for (const char* border : {"shelf", "wall"}) {
      EXPECT_GE(contrast(vision.edge.at(border), vision.fill.at("floor")), 3.0) << name << border;
      EXPECT_GE(contrast(vision.edge.at("box"), vision.edge.at(border)), 4.5) << name << border;
    }
  }
  EXPECT_EQ(find_vision("none"), nullptr);
}

TEST(Vision, the_fills_of_path_and_goal_stand_out_from_the_fills_beside_them) {
  for (const std::string& name : vision_names()) {
    const Vision& vision = *find_vision(name);
    for (const char* way : {"path", "goal"})
      for (const char* beside : {"floor", "shelf", "wall", "box", "pedestal", "other"})
        EXPECT_GE(contrast(vision.fill.at(way), vision.fill.at(beside)), 4.5)
            << name << " " << way << " " << beside;
  }
}

TEST(Vision, the_turn_is_apart_from_the_path_that_it_lies_on) {
  for (const std::string& name : vision_names()) {
    const Vision& vision = *find_vision(name);
    EXPECT_GE(contrast(vision.fill.at("turn"), vision.fill.at("path")), 4.5) << name;
    EXPECT_GE(contrast(vision.fill.at("turn"), vision.bright), 4.5) << name;
  }
}

TEST(Dress, keeps_names_and_deletions_and_leaves_texts_out) {
  MarkerArray array;
  array.markers = {marker("path", Marker::LINE_STRIP), marker("label", Marker::TEXT_VIEW_FACING)};
  array.markers[0].id = 1;
  array.markers[0].action = Marker::DELETE;
  const MarkerArray result = dress(array, *find_vision("high_contrast"));
  ASSERT_EQ(result.markers.size(), 1U);
  EXPECT_EQ(result.markers[0].id, 1);
  EXPECT_EQ(result.markers[0].action, Marker::DELETE);
}

TEST(Dress, what_is_lit_becomes_triangles_of_fixed_colours) {
  Marker list = marker("box", Marker::CUBE_LIST);
  list.points.resize(2);
  for (const Marker& msg :
       {list, marker("goal", Marker::CYLINDER), marker("robot", Marker::CYLINDER)}) {
    const Marker result = dressed(msg);
    EXPECT_EQ(result.type, Marker::TRIANGLE_LIST) << msg.ns;
    EXPECT_EQ(result.points.size(), 3 * result.colors.size()) << msg.ns;
    EXPECT_FALSE(result.points.empty()) << msg.ns;
  }
}

TEST(Dress, what_a_vision_does_not_name_stays_as_it_is) {
  Marker list = marker("stands", Marker::CUBE_LIST);
  list.points.resize(2);
  list.color.a = 0.6F;
  EXPECT_EQ(dressed(list), list);
}

TEST(Dress, each_face_of_a_slanting_box_gets_an_edge) {
  Marker list = marker("box", Marker::TRIANGLE_LIST);
  for (const auto& [x, y] :
       {std::pair{0.0, 0.0}, {1.0, 0.5}, {0.5, 1.5}, {0.0, 0.0}, {0.5, 1.5}, {-0.5, 1.0}}) {
    geometry_msgs::Point point;
    point.x = x;
    point.y = y;
    list.points.push_back(point);
  }
  list.colors.assign(2, list.color);
  EXPECT_EQ(dressed(list).colors.size(), 10U) << "four edges and the fill, two triangles each";
  list.points.back().x = 0.0;
  EXPECT_EQ(dressed(list).colors.size(), 2U) << "no parallelogram";
}

TEST(Dress, the_turn_has_a_bright_edge_in_a_dark_one) {
  Marker turn = marker("turn", Marker::ARROW);
  turn.points.resize(2);
  turn.points[1].x = 1.4;
  for (const std::string& name : vision_names()) {
    std::set<float> greens;
    for (const auto& color : dressed(turn, name.c_str()).colors) greens.insert(color.g);
    const Vision& vision = *find_vision(name);
    EXPECT_EQ(greens, (std::set<float>{vision.dark.g, vision.bright.g, vision.fill.at("turn").g}));
  }
}

TEST(Dress, a_closed_zone_has_one_border_and_a_slow_one_dashes_of_another_colour) {
  for (const std::string& name : vision_names()) {
    const Vision& vision = *find_vision(name);
    std::set<std::tuple<float, float, float>> fills;
    for (const int type : {Marker::LINE_STRIP, Marker::LINE_LIST}) {
      Marker zone = marker("zone", type);
      zone.scale.x = 0.12;
      zone.points.resize(6);
      for (std::size_t i = 0; i < 6; ++i) {
        zone.points[i].x = static_cast<double>(i);
        zone.points[i].z = 1.5;
      }
      const Marker result = dressed(zone, name.c_str());
      double covered = 0.0;  // m, of the line's own colour
      for (std::size_t i = 0; i < result.colors.size(); ++i) {
        EXPECT_EQ(result.points[3 * i].z, 1.5) << "the floor of a robot may be anywhere";
        const auto& color = result.colors[i];
        if (color == color_msg(vision.dark)) continue;
        fills.insert({color.r, color.g, color.b});
        EXPECT_GE(contrast({color.r, color.g, color.b}, vision.fill.at("floor")), 4.5) << name;
        covered += 0.5 * std::abs(result.points[3 * i].x - result.points[3 * i + 1].x) +
                   0.5 * std::abs(result.points[3 * i + 1].x - result.points[3 * i + 2].x) +
                   0.5 * std::abs(result.points[3 * i + 2].x - result.points[3 * i].x);
      }
      EXPECT_NEAR(covered, type == Marker::LINE_STRIP ? 10.0 : 6.0, 0.1) << name;
    }
    EXPECT_EQ(fills.size(), name == "yellow_on_black" ? 1U : 2U) << name;
  }
}

TEST(Dress, so_many_cubes_that_it_would_be_slow_stay_cubes) {
  Marker list = marker("box", Marker::CUBE_LIST);
  list.points.resize(25000);
  EXPECT_EQ(dressed(list).type, Marker::CUBE_LIST);
}

TEST(Dress, the_large_vision_draws_a_wider_path) {
  Marker line = marker("path", Marker::LINE_STRIP);
  line.points.resize(2);
  line.points[1].x = 5.0;
  const auto width = [&](const char* vision) {
    double most = 0.0;
    for (const auto& point : dressed(line, vision).points) most = std::max(most, point.y);
    return most;
  };
  EXPECT_GT(width("large"), 1.5 * width("high_contrast"));
}

}  // namespace
}  // namespace navvi_rviz::look
