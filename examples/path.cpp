// A path on the map of a world: example_path busy 7 prints its corners, in m.
#include <cstdio>
#include <navvi_nav/lockstep/navigation.hpp>
#include <navvi_sim/setup/course.hpp>

int main(int argc, char** argv) {
  navvi_sim::setup::SimNodeConfig config;
  if (argc > 1) config.world = argv[1];
  if (argc > 2) config.seed = std::stoi(argv[2]);
  const auto loaded = navvi_sim::setup::load_world(config);
  const auto course = navvi_sim::setup::course_of(config, loaded.world);

  navvi_nav::lockstep::Navigation navigation{navvi_nav::lockstep::NavigationConfig{}};
  navigation.set_map(course.voxels);
  navigation.set_goal(course.ends.goal);
  for (double time = 0.0; time < 1.0; time += 0.05) {  // beats of navigation
    navigation.set_pose(course.ends.start, loaded.world.floor_height, time);
    navigation.set_obstacles({}, time);
    (void)navigation.update(time);
  }
  for (const Eigen::Vector2d& corner : navigation.path())
    std::printf("%.2f %.2f\n", corner.x(), corner.y());
  return navigation.path().empty() ? 1 : 0;
}
