// A world that is stepped: ten simulated seconds at half speed, and what happened, in m.
#include <cstdio>
#include <navvi_sim/live/session.hpp>
#include <navvi_sim/setup/course.hpp>

int main(int argc, char** argv) {
  navvi_sim::setup::SimNodeConfig config;
  config.world = argc > 1 ? argv[1] : "training";
  const auto world = navvi_sim::setup::load_world(config).world;
  const auto ends = navvi_sim::setup::course_of(config, world).ends;

  navvi_sim::live::Session session(world, config.life, ends.start, 1);
  std::size_t contacts = 0;
  for (unsigned second = 1; second <= 10; ++second) {
    while (session.steps() < 100 * second) {
      (void)session.step({0.5, 0.0});  // m/s and rad/s
      contacts += session.world().now().contacts.size();
    }
    const auto& robot = session.world().now().robot;
    std::printf("%2u s  %.2f %.2f  %zu contacts\n", second, robot.position.x(), robot.position.y(),
                contacts);
  }
  std::printf("state %016llx\n",
              static_cast<unsigned long long>(session.world().state_hash()));
}
