// The program behind `./navvi navmesh`: navmesh_tool MAP [name:=value ...] prints a map's mesh, and
// a path over it, as JSON. MAP is an OctoMap (.bt, .ot) or a map_server map (.yaml); the names are
// nav_node's parameters and those of ToolConfig. Exit codes: 0 done, 1 no path, 2 an error.

#include <algorithm>
#include <chrono>
#include <iostream>
#include <map>
#include <navvi_config/reader.hpp>
#include <navvi_files/json.hpp>
#include <navvi_floor/map_file.hpp>
#include <string>
#include <utility>
#include <vector>

#include "guide/navigator.hpp"
#include "smooth/turns.hpp"

namespace {

using namespace navvi_nav;
using navvi_config::ConfigError;
using namespace navvi_files;

/// The stages of a query, in their order.
enum class Stage { map, bake, mesh, search, smooth };
const std::vector<std::string> kStages = {"map", "bake", "mesh", "search", "smooth"};

struct ToolConfig {
  guide::NavigatorConfig navigator;
  std::string stage_name = "smooth";
  std::string config, picture;
  std::vector<double> from, to, cylinders;
  bool drawing = false;

  void describe(navvi_config::Visitor& visit) {
    using navvi_config::Any;
    navigator.describe(visit);
    visit(stage_name, "stage", navvi_config::OneOf{kStages}, "",
          "the last one: map, bake, mesh (holes), search (shortest path) or smooth");
    visit(config, "config", Any{}, "", "a YAML file of parameters, like those of nav_node");
    visit(picture, "picture", Any{}, "", "a PGM in place of the one that a .yaml map names");
    visit(from, "from", Any{}, "m", "[x, y] where a path begins, in map");
    visit(to, "to", Any{}, "m", "[x, y, ...] where it ends; to all but the first only a refusal");
    visit(cylinders, "cylinders", Any{}, "m", "[x, y, radius, ...] of what moves, cut out");
    visit(drawing, "drawing", Any{}, "", "whether to print floor and polygons as well");
  }
  [[nodiscard]] bool reaches(Stage stage) const {
    return std::find(kStages.begin(), kStages.end(), stage_name) - kStages.begin() >=
           static_cast<std::ptrdiff_t>(stage);
  }
};

ToolConfig read_config(const std::vector<std::string>& words) {
  ToolConfig out;
  const YAML::Node given = navvi_config::read_words(words);
  if (given["config"]) {
    const auto file = given["config"].as<std::string>();
    navvi_config::read(out.navigator, navvi_config::load_yaml(file), file,
                       navvi_config::Removed::ignored);
  }
  navvi_config::read(out, given, "the command line");
  if (out.from.size() != (out.to.empty() ? 0 : 2) || out.to.size() % 2 != 0)
    throw ConfigError("from must be two numbers, such as [1.5, 2], with to, which is two a goal.");
  for (std::size_t i = 2; i < out.cylinders.size() + 2; i += 3)
    if (i >= out.cylinders.size() || !(out.cylinders[i] > 0.0))
      throw ConfigError("cylinders must be x, y and a radius above 0 each, such as [1.5, 2, 0.4].");
  if (!out.reaches(Stage::smooth)) out.navigator.planner.smoothing.enabled = false;
  return out;
}

struct MeshFigures {
  double area = 0.0;     ///< m^2
  double largest = 0.0;  ///< m^2, of the components
  std::size_t polygons = 0, portals = 0, components = 0;
  std::size_t bytes = 0;  ///< of memory
};

MeshFigures figures_of(const mesh::Mesh& mesh) {
  MeshFigures out;
  out.bytes =
      mesh.vertices.size() * sizeof(mesh::Vertex) + mesh.polygons.size() * sizeof(mesh::Polygon);
  std::map<int, double> components;  // m^2
  for (std::size_t i = 0; i < mesh.polygons.size(); ++i) {
    const mesh::Polygon& polygon = mesh.polygons[i];
    if (polygon.corners.empty()) continue;
    ++out.polygons;
    out.portals += polygon.portals.size();
    out.bytes +=
        polygon.corners.size() * sizeof(int) + polygon.portals.size() * sizeof(mesh::Portal);
    const std::vector<Point> corners = mesh.outline(static_cast<int>(i));
    for (std::size_t k = 2; k < corners.size(); ++k)
      components[polygon.component] +=
          cross(corners[k - 1] - corners[0], corners[k] - corners[0]) / 2.0;
  }
  for (const auto& [component, its] : components) {
    out.area += its;
    out.largest = std::max(out.largest, its);
  }
  out.components = components.size();
  out.portals /= 2;  // each is one of both its polygons
  return out;
}

JsonFields fields_of(const std::string& source, const plan::NavMesh& nav_mesh, int tiles) {
  const map::Floor& floor = *nav_mesh.shared_floor();
  const mesh::Mesh& mesh = nav_mesh.mesh();
  const MeshFigures is = figures_of(mesh);
  return {{"map", json_text(source)},
          {"floor length m", json_number(floor.columns() * floor.cell_size(), 2)},
          {"floor width m", json_number(floor.rows() * floor.cell_size(), 2)},
          {"cell m", json_number(floor.cell_size(), 3)},
          {"floor z m", json_number(floor.height(), 2)},
          {"mesh m^2", json_number(is.area, 1)},
          {"polygons", std::to_string(is.polygons)},
          {"vertices", std::to_string(mesh.vertices.size())},
          {"portals", std::to_string(is.portals)},
          {"tiles", std::to_string(tiles)},
          {"components", std::to_string(is.components)},
          {"largest component m^2", json_number(is.largest, 1)},
          {"memory bytes", std::to_string(is.bytes)}};
}

std::string json_of(const Path& path) {
  std::vector<std::string> points;
  for (const Point point : path)
    points.push_back(json_list({json_number(point.x, 2), json_number(point.y, 2)}));
  return json_list(points);
}

/// The floor's rows from the lowest y on, a sign a cell: "." floor, "#" obstacle, " " none; and the
/// polygons of the mesh by component.
void add_drawing(JsonFields& fields, const plan::NavMesh& nav_mesh, bool with_mesh) {
  const map::Floor& floor = *nav_mesh.shared_floor();
  const map::Area area = floor.area();
  std::vector<std::string> rows, polygons;
  for (int y = area.low.y; y < area.high.y; ++y) {
    std::string row;
    for (int x = area.low.x; x < area.high.x; ++x) {
      const map::Ground ground = floor.ground({x, y});
      row += ground == map::Ground::floor ? '.' : ground == map::Ground::obstacle ? '#' : ' ';
    }
    rows.push_back(json_text(row));
  }
  const mesh::Mesh& mesh = nav_mesh.mesh();
  for (std::size_t i = 0; with_mesh && i < mesh.polygons.size(); ++i)
    if (!mesh.polygons[i].corners.empty())
      polygons.push_back(json_list({std::to_string(mesh.polygons[i].component),
                                    json_of(mesh.outline(static_cast<int>(i)))}));
  fields.emplace_back("origin m", json_list({json_number(area.low.x * floor.cell_size()),
                                             json_number(area.low.y * floor.cell_size())}));
  fields.emplace_back("ground", json_list(rows));
  fields.emplace_back("mesh", json_list(polygons));
}

/// ms since the last lap.
class Stopwatch {
 public:
  std::string lap() {
    const auto before = std::exchange(last_, std::chrono::steady_clock::now());
    return json_number(std::chrono::duration<double, std::milli>(last_ - before).count(), 3);
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// \return whether there is a path
bool add_plan(JsonFields& fields, plan::Planner& planner, const ToolConfig& config) {
  Stopwatch watch;
  plan::Plan plan;
  std::string planned;
  for (std::size_t at = config.to.size(); at > 0; at -= 2) {
    const Point goal{config.to[at - 2], config.to[at - 1]};
    plan = planner.plan({config.from[0], config.from[1]}, goal);
    planned = watch.lap();
    if (plan.status == plan::PlanStatus::found) continue;
    fields.emplace_back("refusal",
                        json_text(plan.detail.empty() ? "there is no route" : plan.detail));
    fields.emplace_back("refused m", json_list({json_number(goal.x), json_number(goal.y)}));
    return false;
  }
  Path turns;
  for (const smooth::Turn turn :
       smooth::turns_of(plan.path, config.navigator.path.guidance.one_turn))
    turns.push_back(plan.path[turn.at]);
  if (!turns.empty()) turns.pop_back();  // the goal
  fields.insert(fields.end(), {{"query ms", planned},
                               {"nodes", std::to_string(plan.nodes_expanded)},
                               {"shortest way m", json_number(plan.shortest)},
                               {"guide path m", json_number(length_of(plan.path), 3)},
                               {"path", json_of(plan.path)},
                               {"turns", json_of(turns)}});
  return true;
}

int run(const std::vector<std::string>& words) {
  if (words.empty()) throw ConfigError("no map is named.");
  const std::string& file = words.front();
  const ToolConfig config = read_config({words.begin() + 1, words.end()});
  Stopwatch watch;
  const map::MapSurvey survey =
      map::survey_file(file, plan::survey_config(config.navigator.planner.mesh), config.picture);
  if (!survey.error.empty()) throw ConfigError(survey.error);
  const std::string surveyed = watch.lap();
  plan::Planner planner(config.navigator.planner);
  const plan::MeshUpdate update = planner.set_map(survey);
  if (!update.error.empty()) throw ConfigError(file + ": " + update.error);
  const std::string baked = watch.lap();
  std::vector<Cylinder> cylinders;
  for (auto at = config.cylinders.begin(); at != config.cylinders.end(); at += 3)
    cylinders.push_back(
        {static_cast<std::uint32_t>(cylinders.size() + 1), {at[0], at[1]}, at[2], {}});
  if (config.reaches(Stage::mesh)) planner.carve(cylinders);
  const std::string carved = watch.lap();
  JsonFields fields = fields_of(survey.source, planner.nav_mesh(), update.tiles);
  fields.insert(fields.end(), {{"survey ms", surveyed}, {"bake ms", baked}, {"cut ms", carved}});
  const bool found = config.from.empty() || !config.reaches(Stage::search) ||
                     add_plan(fields, planner, config);
  if (config.drawing) add_drawing(fields, planner.nav_mesh(), config.reaches(Stage::bake));
  std::cout << json_object(fields) << '\n';
  return found ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    const std::string sentence = error.what();  // each library ends its sentences in its own way
    std::cerr << "navmesh: " << sentence << (sentence.back() == '.' ? "\n" : ".\n");
    return 2;
  }
}
