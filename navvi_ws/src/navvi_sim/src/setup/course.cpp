#include "navvi_sim/setup/course.hpp"

#include <navvi_config/writer.hpp>
#include <navvi_files/bytes.hpp>

#include "navvi_sim/description/world_hash.hpp"

namespace navvi_sim::setup {
namespace {

using navvi_files::ByteReader;
using navvi_files::ByteWriter;

/// A world's places are in no hash: neither map nor ends depend on them.
std::string key_of(const SimNodeConfig& config, const WorldDescription& world) {
  return "course\n" + world_hash(world) + "\n" + navvi_config::write(config);
}

void put(ByteWriter& out, const Eigen::Vector2d& point) {
  out.put(point.x());
  out.put(point.y());
}

Eigen::Vector2d get_point(ByteReader& in) {
  const auto x = in.get<double>();
  return {x, in.get<double>()};
}

std::string to_bytes(const Course& course) {
  ByteWriter out;
  out.put(course.map.resolution());
  out.put(course.map.stream());
  put(out, course.ends.start.position);
  out.put(course.ends.start.yaw);
  put(out, course.ends.goal);
  out.put(course.ends.route_length);
  out.put(std::string_view(course.ends.note));
  return out.bytes();
}

std::optional<Course> from_bytes(std::string_view bytes) {
  ByteReader in(bytes);
  const auto resolution = in.get<double>();
  Course out{{resolution, in.get_all<std::int8_t>()}, {}};
  out.ends.start.position = get_point(in);
  out.ends.start.yaw = in.get<double>();
  out.ends.goal = get_point(in);
  out.ends.route_length = in.get<double>();
  out.ends.note = in.get_text();
  return in.ends_well() ? std::optional(std::move(out)) : std::nullopt;
}

}  // namespace

Course course_of(const SimNodeConfig& config, const WorldDescription& world,
                 const navvi_files::Cache* cache) {
  const std::string key = cache != nullptr ? key_of(config, world) : "";
  if (const auto bytes = cache != nullptr ? cache->find(key) : std::nullopt)
    if (auto kept = from_bytes(*bytes)) return *std::move(kept);
  occupancy::OccupancyMap map = map_of(config, world);
  scenario::StartAndGoal ends = scenario_of(config, world, map);
  Course out{std::move(map), std::move(ends)};
  if (cache != nullptr) cache->keep(key, to_bytes(out));
  return out;
}

}  // namespace navvi_sim::setup
