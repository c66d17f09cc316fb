#include <gtest/gtest.h>

#include <navvi_safety/command_gate.hpp>
#include <navvi_sim/live/session.hpp>
#include <navvi_sim/setup/course.hpp>
#include <navvi_sim/setup/sim_node_config.hpp>
#include <random>

namespace navvi_people::loop {
namespace {

constexpr double kMoves = 0.05;   // m/s; what is touched by a slower robot came to it
constexpr double kReach = 5.0;    // m
constexpr double kCommands = 50;  // Hz

struct Drive {
  int contacts = 0;      ///< into which the robot drove
  double driven = 0.0;   ///< m
  double turned = 0.0;   ///< rad, against the stick
  double faster = 0.0;   ///< m/s, than the stick
};

/// A busy hall, and a stick that is moved at random by a hand that knows nothing of it.
Drive drive(const std::string& assistance, int seed, double seconds) {
  navvi_sim::setup::SimNodeConfig config;
  config.world = "busy";
  config.seed = seed;
  config.gate.assistance = assistance;
  const navvi_sim::WorldDescription world = navvi_sim::setup::load_world(config).world;
  const navvi_sim::setup::Course course = navvi_sim::setup::course_of(config, world, nullptr);
  navvi_sim::live::Session session(world, config.life, course.ends.start,
                                   static_cast<std::uint64_t>(seed));
  navvi_safety::CommandGate gate(config.gate);
  std::mt19937 random(static_cast<unsigned>(seed));
  const auto between = [&](double least, double most) {
    return least + (most - least) * (static_cast<double>(random()) / std::mt19937::max());
  };
  navvi_types::Velocity stick, sent;
  double until = 0.5;
  std::uint32_t seq = 0;
  Drive result;
  while (session.world().now().time < seconds) {
    const double time = session.world().now().time;
    if (time > until) {
      stick = {between(-0.4, 0.9), between(-1.0, 1.0)};
      if (between(0.0, 1.0) < 0.5) stick.angular = 0.0;
      until = time + between(0.5, 3.0);
    }
    if (session.due(kCommands)) gate.receive({sent = stick, 0.0, ++seq}, {time, time});
    const navvi_types::Velocity wheels = gate.update({time, time});
    if (wheels.linear != 0.0 || wheels.angular != 0.0) {
      result.faster = std::max(result.faster, std::abs(wheels.linear) - std::abs(sent.linear));
      if (std::abs(sent.angular) > 0.1)
        result.turned = std::max(result.turned, std::abs(sent.angular) -
                                                    std::copysign(1.0, sent.angular) * wheels.angular);
    }
    const Eigen::Vector2d before = session.world().now().robot.position;
    EXPECT_EQ(session.step(wheels), navvi_sim::live::World::Status::running);
    result.driven += (session.world().now().robot.position - before).norm();
    if (session.due(navvi_sim::live::kProximityRate))
      gate.see(session.world().proximity(kReach).things, {time, time});
    for (const navvi_types::Contact& contact : session.world().now().contacts)
      if (std::abs(contact.speed) > kMoves) ++result.contacts;
  }
  return result;
}

TEST(Assistance, lets_a_stick_that_is_moved_at_random_drive_into_nothing) {
  int without = 0;
  for (int seed = 1; seed <= 4; ++seed) {
    without += drive("off", seed, 120.0).contacts;
    for (const char* mode : {"stop", "steer"}) {
      const Drive driven = drive(mode, seed, 120.0);
      EXPECT_EQ(driven.contacts, 0) << mode << " " << seed;
      EXPECT_GT(driven.driven, 4.0) << mode << " " << seed;
      EXPECT_LE(driven.faster, 1e-9) << mode << " " << seed;
      EXPECT_LE(driven.turned, 1e-9) << mode << " " << seed;
    }
  }
  EXPECT_GT(without, 10);
}

}  // namespace
}  // namespace navvi_people::loop
