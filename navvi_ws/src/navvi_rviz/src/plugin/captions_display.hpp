#pragma once

#include <OgreFrameListener.h>
#include <OgreMatrix4.h>
#include <rviz/display.h>
#include <visualization_msgs/MarkerArray.h>

#include <Eigen/Geometry>
#include <ctime>
#include <functional>
#include <map>
#include <memory>
#include <navvi_types/motion.hpp>
#include <navvi_types/thing.hpp>
#include <optional>
#include <string>
#include <vector>

#include "look/skyline.hpp"
#include "look/vision.hpp"
#include "plugin/plate.hpp"
#include "plugin/reader.hpp"
#include "screen/place.hpp"

namespace navvi_rviz::plugin {

/// Words on the screen: what matters now as a banner, the texts among NavVI's markers as plates
/// over their places, the name of who the banner warns of over them, and arrows at the edge to them
/// and to a path that leaves the picture. Also keeps the view from above on the robot, its start
/// and its goal, lifts the one from behind over racks, and takes it back until they are in it.
class CaptionsDisplay : public rviz::Display, private Ogre::FrameListener {
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
  Plate& words(const std::string& name, const std::string& text, int height, bool inverted);
  Plate& painted(const std::string& name, const std::string& key,
                 const std::function<QImage()>& paint);

  struct Mover {
    navvi_types::ThingClass thing_class;
    Eigen::AlignedBox3d place;  ///< m, in map
  };
  using Paint = std::function<QImage(double angle, int size)>;

  /// A plate that points. \param angle  rad, counter-clockwise from right
  Plate& pointer(const std::string& name, double angle, int size, const Paint& paint);
  /// px, of the arrows at the picture's edge
  [[nodiscard]] int edge_size() const;
  /// The plate of that name beside a place of the picture, px, if there is room.
  void show_beside(const std::string& name, const Eigen::Vector2d& place);
  /// An arrow at the picture's edge to a place beyond it.
  void show_edge_arrow(const std::string& name, const screen::EdgeArrow& arrow,
                       const look::Color& fill);
  /// Who the banner warns of: of their kind, the nearest to where they close the path, or to the
  /// robot.
  [[nodiscard]] const Mover* threat(const status::Shown& shown,
                                    const navvi_types::Pose2& robot) const;
  [[nodiscard]] bool from_above() const;
  /// px, where a thing is in the picture, also if part of it is behind the camera; empty: nowhere
  /// \param thing  m, in map
  [[nodiscard]] screen::Rect seen(const Eigen::AlignedBox3d& thing) const;
  /// What plates leave free: of what moves and of the path what is within `reach` of the robot.
  /// \param reach  m
  [[nodiscard]] screen::Taken things(const std::optional<navvi_types::Pose2>& robot,
                                     double reach) const;
  void show_banner(const status::Shown& shown);
  void show_threat(const Mover& threat);
  void show_way(const navvi_types::Pose2& robot);
  void show_labels();
  /// The view from above holds the robot, the start, the goal and the path, and shows where they
  /// are.
  void show_from_above(const navvi_types::Pose2& robot);
  /// The view from behind looks over what stands between it and the robot, from farther away as
  /// long as a threat is not in it. \param time  s, since it last did so
  void show_from_behind(const navvi_types::Pose2& robot, const Mover* threat, double time);

  bool frameStarted(const Ogre::FrameEvent& event) override;
  bool frameEnded(const Ogre::FrameEvent& event) override;
  /// Once a second, in /diagnostics: how often the picture is drawn, and what that costs.
  void tell_rate();
  /// Has the window drawn, if anything in it has changed, or might have.
  void draw_if_changed(const Ogre::Camera& camera);

  std::unique_ptr<Reader> reader_;
  ros::Publisher diagnostics_;
  struct {
    std::string text;
    double share = 1.0;  ///< of its largest letters
  } banner_;
  struct {
    int drawn = 0;            ///< pictures
    std::clock_t used = 0;    ///< by this process, all threads, while it drew them
    ros::SteadyTime since;    ///< that time
  } cost_;
  std::clock_t begun_ = 0;  ///< the picture that is drawn
  struct Drawn {
    Ogre::Matrix4 view, lens;
    unsigned changes = 0;
    std::string plates;
    [[nodiscard]] bool operator==(const Drawn& other) const {
      return view == other.view && lens == other.lens && changes == other.changes &&
             plates == other.plates;
    }
  } drawn_;
  ros::SteadyTime drawn_at_;
  bool first_ = true;  ///< nothing was drawn yet
  int height_ = 26;    ///< px, of capital letters
  Eigen::Vector2d picture_ = Eigen::Vector2d::Zero();  ///< px, its size
  screen::Taken taken_;                                ///< by what is shown in it so far
  std::optional<Eigen::Vector2d> start_,
      goal_;  ///< m, in map: where the robot was when it got its goal
  ros::Subscriber markers_, scene_, obstacles_;
  look::Skyline skyline_;
  std::vector<Eigen::AlignedBox3d> goal_parts_, pedestals_;           ///< m, in map
  std::vector<Mover> movers_;
  std::map<int, std::pair<std::string, Eigen::Vector3d>> labels_;     ///< by id, place in map, m
  std::vector<Eigen::Vector3d> path_;                                 ///< m, in map
  std::map<std::string, Painted> plates_;
};

}  // namespace navvi_rviz::plugin
