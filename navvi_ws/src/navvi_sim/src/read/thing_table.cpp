#include "read/thing_table.hpp"

#include <algorithm>
#include <array>
#include <iomanip>
#include <sstream>
#include <vector>

#include "description/sentence.hpp"

namespace navvi_sim::read {
namespace {

using Line = std::array<std::string, 6>;

std::string counted(std::size_t count, const std::string& one, const std::string& many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

std::string shapes_of(const Thing& thing) {
  std::array<std::size_t, 4> counts{};
  std::size_t triangles = 0;
  for (const Shape& shape : thing.shapes) {
    ++counts[shape.geometry.index()];
    if (const auto* mesh = std::get_if<std::shared_ptr<const Mesh>>(&shape.geometry))
      triangles += (*mesh)->triangles.size();
  }
  const std::array<std::pair<const char*, const char*>, 4> words{
      {{"box", "boxes"}, {"cylinder", "cylinders"}, {"sphere", "spheres"}, {"mesh", "meshes"}}};
  std::string text;
  for (std::size_t kind = 0; kind < counts.size(); ++kind)
    if (counts[kind] > 0)
      text +=
          (text.empty() ? "" : ", ") + counted(counts[kind], words[kind].first, words[kind].second);
  if (triangles > 0) text += " (" + counted(triangles, "triangle", "triangles") + ")";
  return text;
}

std::string position_of(const Thing& thing) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(2) << thing.pose.translation().x() << ", "
       << thing.pose.translation().y() << ", " << thing.pose.translation().z();
  return text.str();
}

std::string route_of(const Thing& thing) {
  if (!thing.route) return "";
  std::ostringstream text;
  text << thing.route->waypoints.size() << " way-points at " << std::setprecision(2)
       << thing.route->speed << " m/s" << (thing.route->loop ? ", for ever" : ", once");
  return text.str();
}

Line line_of(const Thing& thing, const LoadedWorld& loaded) {
  const auto rule = loaded.rules.find(thing.name);
  return {shortened(thing.name, 60),
          to_string(thing.thing_class),
          rule == loaded.rules.end() ? "-" : rule->second,
          shapes_of(thing),
          position_of(thing),
          route_of(thing)};
}

}  // namespace

std::string thing_table(const LoadedWorld& loaded, std::size_t most) {
  const std::vector<Thing>& things = loaded.world.things;
  std::vector<Line> lines{{"name", "class", "rule", "shapes", "position", "moves"}};
  for (std::size_t i = 0; i < std::min(most, things.size()); ++i)
    lines.push_back(line_of(things[i], loaded));
  std::array<std::size_t, 6> widths{};
  for (const Line& line : lines)
    for (std::size_t i = 0; i < line.size(); ++i) widths[i] = std::max(widths[i], line[i].size());
  std::string table;
  for (const Line& line : lines) {
    std::string row;
    for (std::size_t i = 0; i < line.size(); ++i)
      row += line[i] + std::string(widths[i] - line[i].size() + 2, ' ');
    table += row.substr(0, row.find_last_not_of(' ') + 1) + "\n";
  }
  if (things.size() > most) table += "and " + std::to_string(things.size() - most) + " more\n";
  return table;
}

}  // namespace navvi_sim::read
