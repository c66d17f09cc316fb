#pragma once

#include <rviz/display.h>
#include <visualization_msgs/MarkerArray.h>

#include <Eigen/Geometry>
#include <functional>
#include <map>
#include <memory>
#include <navvi_types/motion.hpp>
#include <optional>
#include <string>
#include <vector>

#include "look/skyline.hpp"
#include "plugin/plate.hpp"
#include "plugin/reader.hpp"
#include "screen/place.hpp"

namespace navvi_rviz::plugin {

/// Words on the screen: what matters now as a banner, the texts among NavVI's markers as plates
/// over their places, and an arrow at the edge where the path leaves the picture. Also keeps the
/// view from above on the robot, its start and its goal, and lifts the one from behind over racks.
class CaptionsDisplay : public rviz::Display {
 public:
  ~CaptionsDisplay() override;
  void onInitialize() override;
  void update(float wall_dt, float ros_dt) override;
  /// Nothing more is drawn once RViz's window has been closed: it has no size then, and Mesa would
  /// write pixels beyond a buffer of no bytes.
  bool eventFilter(QObject* window, QEvent* event) override;

 protected:
  void onDisable() override;

 private:
  /// A plate, and what is painted on it.
  struct Painted {
    std::unique_ptr<Plate> plate;
    std::string key;
    std::optional<Eigen::Vector2d> place;  ///< px, from what it is beside to its corner
  };

  /// Of a place in map: in the camera's frame, and on the screen if it is before the camera.
  struct Seen {
    Eigen::Vector3d in_camera;
    std::optional<Eigen::Vector2d> pixel;
  };

  void take(const visualization_msgs::MarkerArray& markers);
  [[nodiscard]] Seen see(const Eigen::Vector3d& place) const;
  /// px \param in_camera  m, before the camera: z < 0
  [[nodiscard]] Eigen::Vector2d pixel(const Eigen::Vector3d& in_camera) const;
  /// base_link in the fixed frame.
  [[nodiscard]] std::optional<navvi_types::Pose2> robot() const;
  /// The plate of that name with these words on it.
  Plate& words(const std::string& name, const std::string& text, int height, bool inverted);
  Plate& painted(const std::string& name, const std::string& key,
                 const std::function<QImage()>& paint);

  /// An arrow's plate. \param angle  rad, counter-clockwise from right
  Plate& arrow(const std::string& name, double angle, int size);
  [[nodiscard]] bool from_above() const;
  /// px, where a thing is in the picture, also if part of it is behind the camera; empty: nowhere
  /// \param thing  m, in map
  [[nodiscard]] screen::Rect seen(const Eigen::AlignedBox3d& thing) const;
  /// What plates leave free: of what moves and of the path what is within `reach` of the robot.
  /// \param reach  m
  [[nodiscard]] screen::Taken things(const std::optional<navvi_types::Pose2>& robot, double reach,
                                     const Eigen::Vector2d& picture) const;
  void show_banner(const Eigen::Vector2d& picture, screen::Taken& taken);
  void show_way(const navvi_types::Pose2& robot, const Eigen::Vector2d& picture,
                screen::Taken& taken);
  void show_labels(const Eigen::Vector2d& picture, const screen::Taken& taken);
  /// The view from above holds the robot, the start, the goal and the path, and shows where they
  /// are.
  void show_from_above(const navvi_types::Pose2& robot, const Eigen::Vector2d& picture,
                       screen::Taken& taken);
  /// The view from behind looks over what stands between it and the robot.
  /// \param time  s, since it last did so
  void show_from_behind(const navvi_types::Pose2& robot, double time);

  std::unique_ptr<Reader> reader_;
  bool first_ = true;  ///< nothing was drawn yet
  int height_ = 26;    ///< px, of capital letters
  std::optional<Eigen::Vector2d> start_,
      goal_;  ///< m, in map: where the robot was when it got its goal
  ros::Subscriber markers_, scene_, moving_scene_;
  look::Skyline skyline_;
  std::vector<Eigen::AlignedBox3d> goal_parts_, pedestals_, movers_;  ///< m, in map
  std::map<int, std::pair<std::string, Eigen::Vector3d>> labels_;     ///< by id, place in map, m
  std::vector<Eigen::Vector3d> path_;                                 ///< m, in map
  std::map<std::string, Painted> plates_;
};

}  // namespace navvi_rviz::plugin
