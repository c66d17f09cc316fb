// scene_player BAG: shows what moved while BAG was recorded, at the time of /clock. Bags hold the
// commands from which the simulation is repeated, not the picture.

#include <ros/ros.h>
#include <rosgraph_msgs/Clock.h>

#include <cmath>
#include <navvi_config/ros_parameters.hpp>
#include <navvi_sim/scene/scene.hpp>

#include "recount/repetition.hpp"

namespace navvi_study::tool {
namespace {

class ScenePlayer {
 public:
  /// \throws std::runtime_error with a sentence if the simulation cannot be repeated
  explicit ScenePlayer(const std::string& bag)
      : recorded_(recount::session_in_bag(bag)),
        world_(recount::world_of(recorded_)),
        looks_(world_.description, world_.config.robot),
        every_(std::llround(1.0 / (navvi_sim::live::kObstaclesRate * world_.config.step))),
        moving_(node_.advertise<visualization_msgs::MarkerArray>("navvi/scene_moving", 1)),
        clock_(node_.subscribe("/clock", 1, &ScenePlayer::follow, this)) {}

 private:
  void follow(const rosgraph_msgs::Clock& now) {
    const long long steps = std::llround(now.clock.toSec() / world_.config.step);
    if (steps / every_ == shown_) return;
    shown_ = steps / every_;
    // What cannot go on, as in a world that has stopped, is shown where it is.
    (void)navvi_sim::live::replay(world_.session, recorded_.commands,
                                  static_cast<std::uint64_t>(steps));
    const navvi_sim::live::Snapshot& scene = world_.session.world().now();
    moving_.publish(looks_.moving(scene, ros::Time(scene.time)));
  }

  ros::NodeHandle node_;
  recount::RecordedSession recorded_;
  recount::RepeatedWorld world_;
  navvi_sim::scene::Scene looks_;
  long long every_;  ///< steps from one picture to the next
  long long shown_ = -1;
  ros::Publisher moving_;
  ros::Subscriber clock_;
};

}  // namespace
}  // namespace navvi_study::tool

int main(int argc, char** argv) {
  navvi_config::init(argc, argv, "scene_player");
  if (argc != 2) {
    std::fprintf(stderr, "usage: scene_player BAG\n");
    return 2;
  }
  return navvi_config::run_node<navvi_config::NoParameters>([&](auto) {
    try {
      const navvi_study::tool::ScenePlayer player(argv[1]);
      navvi_config::spin();
    } catch (const std::exception& error) {
      ROS_WARN("The picture lacks the moving things: %s.", error.what());
    }
    return 0;
  });
}
