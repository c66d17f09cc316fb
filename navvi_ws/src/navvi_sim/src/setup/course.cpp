#include "navvi_sim/setup/course.hpp"

#include <navvi_config/writer.hpp>
#include <navvi_files/bytes.hpp>
#include <navvi_floor/map_survey.hpp>

#include "navvi_sim/description/world_description.hpp"
#include "scenario/floor_ways.hpp"

namespace navvi_sim::setup {
namespace {

/// A world's places are in no hash: the ends do not depend on them.
std::string key_of(const SimNodeConfig& config, const WorldDescription& world) {
  return "course\n" + world_hash(world) + "\n" + navvi_config::write(config);
}

std::string to_bytes(const scenario::StartAndGoal& ends) {
  navvi_files::ByteWriter out;
  out.put(ends.start.position.x(), ends.start.position.y(), ends.start.yaw, ends.goal.x(),
          ends.goal.y(), ends.route_length, ends.note);
  return out.bytes();
}

scenario::StartAndGoal from_bytes(std::string_view bytes) {
  navvi_files::ByteReader in(bytes);
  scenario::StartAndGoal ends;
  in.get(ends.start.position.x(), ends.start.position.y(), ends.start.yaw, ends.goal.x(),
         ends.goal.y(), ends.route_length, ends.note);
  return ends;
}

}  // namespace

Course course_of(const SimNodeConfig& config, const WorldDescription& world,
                 const navvi_files::Cache* cache) {
  Course out{voxels_of(config, world), {}};
  const std::string key = cache != nullptr ? key_of(config, world) : "";
  if (const auto bytes = cache != nullptr ? cache->find(key) : std::nullopt) {
    out.ends = from_bytes(*bytes);
    return out;
  }
  navvi_floor::see_ground(
      out.voxels, scenario::level_survey(world.floor_height, config.life.robot.height));
  out.ends = scenario_of(config, world, out.voxels);
  if (cache != nullptr) cache->keep(key, to_bytes(out.ends));
  return out;
}

}  // namespace navvi_sim::setup
