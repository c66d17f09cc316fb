// A map in; its mesh in numbers, as a picture, and a path over it.

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <navvi_config/reader.hpp>
#include <navvi_files/json.hpp>
#include <navvi_floor/map_file.hpp>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "guide/navigator.hpp"
#include "smooth/turns.hpp"
#include "tool/mesh_picture.hpp"

namespace {

using namespace navvi_nav;
using namespace navvi_nav::tool;

constexpr const char* kUsage =
    R"(navmesh MAP [-o FILE.svg] [--from X,Y --to X,Y] [--cylinder X,Y,R ...] [--config FILE.yaml]
        [--stage STAGE] [--json FILE] [name:=value ...]
  MAP         an OctoMap (.bt, .ot) or a map_server map (.yaml)
  -o          draw the map, its mesh, the cylinders and the path; ./navvi also takes FILE.png
  --from --to search a path, m in map
  --cylinder  cut a hole around something that moves, m in map
  --stage     stop after map, bake, mesh (holes), search (shortest path) or smooth (the default)
  --config    parameters that differ from the defaults, as in nav_node's config files; single ones
              as in mesh/climb:=0.1
  --json FILE the numbers and the path, or why there is none, for a program
)";

class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The stages of a query, in their order.
enum class Stage { map, bake, mesh, search, smooth };
constexpr std::array<const char*, 5> kStages = {"map", "bake", "mesh", "search", "smooth"};

Stage stage_named(const std::string& word) {
  const auto found = std::find(kStages.begin(), kStages.end(), word);
  if (found == kStages.end())
    throw UsageError("\"" + word +
                     "\" is not a stage; map, bake, mesh, search and smooth are allowed");
  return static_cast<Stage>(found - kStages.begin());
}

struct Options {
  std::string map;
  std::string picture;
  std::string config;
  std::string json;
  Stage stage = Stage::smooth;
  std::optional<Point> from;
  std::optional<Point> to;
  std::vector<Cylinder> cylinders;
  std::vector<std::string> parameters;  ///< name:=value
  bool help = false;
};

std::vector<double> numbers_in(const std::string& option, const std::string& text,
                               std::size_t count) {
  std::vector<double> out;
  std::istringstream stream(text);
  stream.imbue(std::locale::classic());
  for (double value = 0.0; stream >> value;) {
    out.push_back(value);
    if (stream.peek() != ',') break;
    stream.ignore();
  }
  if (out.size() != count || stream.peek() != std::istringstream::traits_type::eof())
    throw UsageError(option + " \"" + text + "\" is not " + std::to_string(count) +
                     " numbers with commas between, such as " +
                     (count == 2 ? "1.5,2" : "1.5,2,0.4"));
  return out;
}

Options read_options(const std::vector<std::string>& words) {
  Options out;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string& word = words[i];
    const auto value = [&]() -> const std::string& {
      if (i + 1 == words.size()) throw UsageError(word + " needs a value");
      return words[++i];
    };
    const auto point = [&] {
      const std::vector<double> at = numbers_in(word, value(), 2);
      return Point{at[0], at[1]};
    };
    if (word == "--help") {
      out.help = true;
    } else if (word == "--picture" || word == "-o") {
      out.picture = value();
      if (std::filesystem::path(out.picture).extension() != ".svg")
        throw UsageError("\"" + out.picture +
                         "\" cannot be drawn; allowed is .svg");
    } else if (word == "--stage") {
      out.stage = stage_named(value());
    } else if (word == "--config") {
      out.config = value();
    } else if (word == "--json") {
      out.json = value();
    } else if (word == "--from") {
      out.from = point();
    } else if (word == "--to") {
      out.to = point();
    } else if (word == "--cylinder") {
      const std::vector<double> at = numbers_in(word, value(), 3);
      if (!(at[2] > 0.0)) throw UsageError("the radius of a cylinder must be more than 0");
      out.cylinders.push_back(
          {static_cast<std::uint32_t>(out.cylinders.size() + 1), {at[0], at[1]}, at[2], {}});
    } else if (word.rfind("--", 0) == 0) {
      throw UsageError("\"" + word + "\" is not an option");
    } else if (word.find(":=") != std::string::npos) {
      out.parameters.push_back(word);
    } else if (out.map.empty()) {
      out.map = word;
    } else {
      throw UsageError("unexpected argument \"" + word + "\"; one map is enough");
    }
  }
  if (out.map.empty() && !out.help) throw UsageError("no map is named");
  if (out.from.has_value() != out.to.has_value()) throw UsageError("--from and --to go together");
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

/// What a program reads; print_mesh() and print_plan() print the same for people.
using navvi_files::JsonFields;

JsonFields print_mesh(const std::string& source, const plan::NavMesh& nav_mesh,
                      const plan::MeshUpdate& update) {
  const map::Floor& floor = *nav_mesh.shared_floor();
  const mesh::Mesh& mesh = nav_mesh.mesh();
  const MeshFigures is = figures_of(mesh);
  if (!source.empty()) std::printf("map         %s\n", source.c_str());
  std::printf("floor       %.2f x %.2f m in cells of %.3g m, at z = %.2f m\n",
              floor.columns() * floor.cell_size(), floor.rows() * floor.cell_size(),
              floor.cell_size(), floor.height());
  std::printf(
      "mesh        %.1f m^2, %zu polygons, %zu vertices, %zu portals, %d tiles, %zu components, "
      "the "
      "largest of %.1f m^2\n",
      is.area, is.polygons, mesh.vertices.size(), is.portals, update.tiles, is.components,
      is.largest);
  std::printf("memory      %zu bytes, %.1f a square metre\n", is.bytes,
              static_cast<double>(is.bytes) / is.area);
  using navvi_files::json_number;
  return {{"map", navvi_files::json_text(source)},
          {"floor length m", json_number(floor.columns() * floor.cell_size(), 2)},
          {"floor width m", json_number(floor.rows() * floor.cell_size(), 2)},
          {"cell m", json_number(floor.cell_size(), 3)},
          {"floor z m", json_number(floor.height(), 2)},
          {"mesh m^2", json_number(is.area, 1)},
          {"polygons", std::to_string(is.polygons)},
          {"vertices", std::to_string(mesh.vertices.size())},
          {"portals", std::to_string(is.portals)},
          {"tiles", std::to_string(update.tiles)},
          {"components", std::to_string(is.components)},
          {"largest component m^2", json_number(is.largest, 1)},
          {"memory bytes", std::to_string(is.bytes)}};
}

std::string json_of(const Path& path) {
  std::vector<std::string> points;
  for (const Point point : path)
    points.push_back(navvi_files::json_list(
        {navvi_files::json_number(point.x, 2), navvi_files::json_number(point.y, 2)}));
  return navvi_files::json_list(points);
}

void print_plan(const plan::Plan& plan, const Path& turns, double milliseconds,
                JsonFields& fields) {
  std::printf("query       %.3f ms with smoothing, %zu nodes\n", milliseconds, plan.nodes_expanded);
  std::printf("shortest    %.6f m\n", plan.shortest);
  std::printf("guide path  %.3f m:", length_of(plan.path));
  for (const Point point : plan.path) std::printf(" %.2f,%.2f", point.x, point.y);
  std::printf("\nturns       %zu:", turns.size());
  for (const Point point : turns) std::printf(" %.2f,%.2f", point.x, point.y);
  std::puts("");
  fields.emplace_back("query ms", navvi_files::json_number(milliseconds, 3));
  fields.emplace_back("shortest way m", navvi_files::json_number(plan.shortest));
  fields.emplace_back("guide path m", navvi_files::json_number(length_of(plan.path), 3));
  fields.emplace_back("path", json_of(plan.path));
  fields.emplace_back("turns", json_of(turns));
}

/// Each library ends its sentences in its own way.
void tell(std::string sentence) {
  if (sentence.back() != '.') sentence += '.';
  std::cerr << "navmesh: " << sentence << '\n';
}

guide::NavigatorConfig config_of(const Options& options) {
  guide::NavigatorConfig config;
  if (!options.config.empty())
    navvi_config::read(config, navvi_config::load_yaml(options.config), options.config,
                       navvi_config::Removed::ignored);
  navvi_config::read(config, navvi_config::read_words(options.parameters), "the command line");
  if (options.stage == Stage::search) config.planner.smoothing.enabled = false;
  return config;
}

/// ms since the last lap.
class Stopwatch {
 public:
  double lap() {
    const auto before = std::exchange(last_, std::chrono::steady_clock::now());
    return std::chrono::duration<double, std::milli>(last_ - before).count();
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// The map's mesh with its holes, as far as the stage asks for; prints it in numbers.
plan::Planner planner_on_map(const Options& options, const plan::PlannerConfig& config,
                             JsonFields& fields) {
  Stopwatch watch;
  const map::MapSurvey survey = map::survey_file(options.map, plan::survey_config(config.mesh));
  if (!survey.error.empty()) throw UsageError(survey.error);
  const double surveyed = watch.lap();
  plan::Planner planner(config);
  const plan::MeshUpdate update = planner.set_map(survey);
  if (!update.error.empty()) throw UsageError(options.map + ": " + update.error);
  const double baked = watch.lap();
  if (options.stage >= Stage::mesh) planner.carve(options.cylinders);
  const double carved = watch.lap();
  fields = print_mesh(survey.source, planner.nav_mesh(), update);
  std::printf("time        %.1f ms to read and survey, %.1f ms to bake, %.2f ms to cut holes\n",
              surveyed, baked, carved);
  return planner;
}

PictureOf picture_of(const Options& options, const plan::NavMesh& nav_mesh) {
  PictureOf out;
  out.floor = nav_mesh.shared_floor().get();
  if (options.stage >= Stage::bake) out.mesh = &nav_mesh.mesh();
  if (options.stage >= Stage::mesh) out.cylinders = options.cylinders;
  return out;
}

/// Prints the path and puts it into the picture. \returns why there is none; empty: there is one
std::string plan_into(PictureOf& picture, plan::Planner& planner, const Options& options,
                      double one_turn, JsonFields& fields) {
  Stopwatch watch;
  const plan::Plan plan = planner.plan(*options.from, *options.to);
  const double planned = watch.lap();
  if (plan.status != plan::PlanStatus::found)
    return plan.detail.empty() ? "there is no route" : plan.detail;
  picture.path = plan.path;
  for (const smooth::Turn turn : smooth::turns_of(plan.path, one_turn))
    picture.turns.push_back(plan.path[turn.at]);
  if (!picture.turns.empty()) picture.turns.pop_back();  // the goal
  print_plan(plan, picture.turns, planned, fields);
  return {};
}

int run(const Options& options) {
  const guide::NavigatorConfig config = config_of(options);
  std::ofstream file;
  if (!options.picture.empty()) {
    file.open(options.picture);
    if (!file) throw UsageError(options.picture + ": the picture cannot be written");
  }
  JsonFields fields;
  plan::Planner planner = planner_on_map(options, config.planner, fields);
  PictureOf picture = picture_of(options, planner.nav_mesh());
  std::string refusal;
  if (options.from && options.stage >= Stage::search)
    refusal = plan_into(picture, planner, options, config.path.guidance.one_turn, fields);
  if (!refusal.empty()) fields.emplace_back("refusal", navvi_files::json_text(refusal));
  if (!options.picture.empty()) {
    file << svg_of(picture);
    if (!file.flush()) throw UsageError(options.picture + ": the picture cannot be written");
  }
  if (!options.json.empty()) navvi_files::write_json(options.json, fields);
  if (refusal.empty()) return 0;
  tell(refusal);
  return 1;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const Options options = read_options({argv + 1, argv + argc});
    if (options.help) {
      std::cout << kUsage;
      return 0;
    }
    return run(options);
  } catch (const std::exception& error) {
    tell(error.what());
  }
  return 2;
}
