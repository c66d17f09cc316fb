#include "navvi_sim/setup/course.hpp"

#include <navvi_config/writer.hpp>
#include <navvi_files/bytes.hpp>

#include "navvi_sim/description/world_hash.hpp"

namespace navvi_sim::setup {
namespace {

/// A world's places are in no hash: neither map nor ends depend on them.
std::string key_of(const SimNodeConfig& config, const WorldDescription& world) {
  return "course\n" + world_hash(world) + "\n" + navvi_config::write(config);
}

std::string to_bytes(const Course& course) {
  const scenario::StartAndGoal& ends = course.ends;
  navvi_files::ByteWriter out;
  out.put(course.map.resolution(), course.map.stream(), ends.start.position.x(),
          ends.start.position.y(), ends.start.yaw, ends.goal.x(), ends.goal.y(), ends.route_length,
          ends.note);
  return out.bytes();
}

Course from_bytes(std::string_view bytes) {
  navvi_files::ByteReader in(bytes);
  double resolution = 0.0;
  std::vector<std::int8_t> stream;
  scenario::StartAndGoal ends;
  in.get(resolution, stream, ends.start.position.x(), ends.start.position.y(), ends.start.yaw,
         ends.goal.x(), ends.goal.y(), ends.route_length, ends.note);
  return {{resolution, std::move(stream)}, std::move(ends)};
}

}  // namespace

Course course_of(const SimNodeConfig& config, const WorldDescription& world,
                 const navvi_files::Cache* cache) {
  const std::string key = cache != nullptr ? key_of(config, world) : "";
  if (const auto bytes = cache != nullptr ? cache->find(key) : std::nullopt)
    return from_bytes(*bytes);
  occupancy::OccupancyMap map = map_of(config, world);
  scenario::StartAndGoal ends = scenario_of(config, world, map);
  Course out{std::move(map), std::move(ends)};
  if (cache != nullptr) cache->keep(key, to_bytes(out));
  return out;
}

}  // namespace navvi_sim::setup
