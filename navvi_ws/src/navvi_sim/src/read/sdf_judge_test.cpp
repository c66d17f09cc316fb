// Each thing of a world beside what libsdformat reads: place, kind, size, count.
// NAVVI_WORLDS: a folder of worlds that others wrote, where it is not that beside the project.

#include <gtest/gtest.h>

#if __has_include(<sdf/sdf.hh>)

#include <cstdlib>
#include <fstream>
#include <set>
#include <sstream>

#include "description/floor_height.hpp"
#include "libsdformat.hpp"
#include "sdf_folder.hpp"

namespace navvi_sim::read {
namespace {

namespace fs = std::filesystem;

/// A shape in map: its kind, its sizes, and where it is.
struct Placed {
  char kind;  ///< b, c, s, m
  Eigen::Vector3d size;
  Eigen::Isometry3d pose;

  [[nodiscard]] bool is_like(const Placed& other) const {
    return kind == other.kind && (size - other.size).norm() < 1e-6 &&
           (pose.matrix() - other.pose.matrix()).cwiseAbs().maxCoeff() < 1e-5;
  }
};

std::vector<Placed> shapes_of(const Thing& thing) {
  std::vector<Placed> all;
  for (const Shape& shape : thing.shapes) {
    Placed placed{'m', Eigen::Vector3d::Zero(), thing.pose * shape.pose};
    if (const auto* box = std::get_if<Box>(&shape.geometry)) {
      placed.kind = 'b';
      placed.size = box->size;
    } else if (const auto* cylinder = std::get_if<Cylinder>(&shape.geometry)) {
      placed.kind = 'c';
      placed.size = {cylinder->radius, cylinder->length, 0.0};
    } else if (const auto* sphere = std::get_if<Sphere>(&shape.geometry)) {
      placed.kind = 's';
      placed.size = {sphere->radius, 0.0, 0.0};
    }
    all.push_back(placed);
  }
  return all;
}

/// None for a plane, which has no end.
std::vector<Placed> shapes_of(const JudgedCollision& judged) {
  const auto ball = [&](double radius, double up) {
    return Placed{'s', {radius, 0.0, 0.0}, judged.pose * Eigen::Translation3d(0.0, 0.0, up)};
  };
  switch (judged.geometry->Type()) {
    case sdf::GeometryType::BOX: {
      const auto size = judged.geometry->BoxShape()->Size();
      return {{'b', {size.X(), size.Y(), size.Z()}, judged.pose}};
    }
    case sdf::GeometryType::CYLINDER: {
      const auto* shape = judged.geometry->CylinderShape();
      return {{'c', {shape->Radius(), shape->Length(), 0.0}, judged.pose}};
    }
    case sdf::GeometryType::SPHERE:
      return {ball(judged.geometry->SphereShape()->Radius(), 0.0)};
    case sdf::GeometryType::CAPSULE: {
      const auto* shape = judged.geometry->CapsuleShape();
      return {{'c', {shape->Radius(), shape->Length(), 0.0}, judged.pose},
              ball(shape->Radius(), shape->Length() / 2.0),
              ball(shape->Radius(), -shape->Length() / 2.0)};
    }
    case sdf::GeometryType::MESH:
    case sdf::GeometryType::ELLIPSOID:
      return {{'m', Eigen::Vector3d::Zero(), judged.pose}};
    default:
      if (!judged.geometry->Element()->HasElement("polyline")) return {};
      return {{'m', Eigen::Vector3d::Zero(), judged.pose}};
  }
}

class Judge : public SdfFolder {
 protected:
  /// What libsdformat reads of a world; null where it has none or throws.
  [[nodiscard]] std::unique_ptr<sdf::Root> judged(const std::string& file,
                                                  const std::vector<fs::path>& models) {
    drops_ = false;
    const auto find = [models](const std::string& uri) -> std::string {
      const std::size_t scheme = uri.find("://");
      const std::string path = scheme == std::string::npos ? uri : uri.substr(scheme + 3);
      for (const fs::path& folder : models)
        if (fs::exists(folder / path)) return (folder / path).string();
      return "";
    };
    sdf::setFindCallback(find);  // of includes in models
    sdf::ParserConfig config;
    config.SetFindCallback(find);
    auto root = std::make_unique<sdf::Root>();
    try {
      // It finds fault with masses, which move nothing here, and with what NavVI refuses. Of two
      // elements of one name it drops the second, which Gazebo keeps.
      for (const sdf::Error& error : root->Load(file, config))
        drops_ = drops_ || error.Code() == sdf::ErrorCode::DUPLICATE_NAME;
    } catch (...) {  // of names such as a::b it throws what is no std::exception
      return nullptr;
    }
    if (root->WorldCount() == 0) return nullptr;
    return root;
  }

  /// The world without its <state>, which libsdformat does not apply.
  [[nodiscard]] std::string without_state(const fs::path& world) const {
    std::ifstream stream(world);
    std::ostringstream text;
    text << stream.rdbuf();
    std::string plain = text.str();
    for (std::size_t at; (at = plain.find("<state")) != std::string::npos;) {
      const std::size_t end = plain.find("</state>", at);
      if (end == std::string::npos) break;
      plain.erase(at, end + 8 - at);
    }
    return write("judged.world", plain);
  }

  /// The number of shapes that were compared; 0 where libsdformat or NavVI refuses the world.
  std::size_t compare(const fs::path& world) {
    std::vector<fs::path> models;
    std::string list;
    for (const fs::path& folder : {world.parent_path(), world.parent_path().parent_path()})
      for (const fs::path& place : {folder / "models", folder})
        if (fs::is_directory(place)) {
          models.push_back(place);
          list += (list.empty() ? "" : ":") + place.string();
        }
    const std::string file = without_state(world);
    const auto root = judged(file, models);
    if (!root) return 0;
    LoadedWorld ours;
    try {
      ours = load_world({file, list, 1, Workers::as_laid_out, "", Missing::leave_out});
    } catch (const WorldError&) {
      return 0;
    }
    return compare(*root->WorldByIndex(0), ours, world.string());
  }

  std::size_t compare(const sdf::World& theirs, const LoadedWorld& ours,
                      const std::string& where) const {
    std::set<std::string> actors;
    for (std::uint64_t i = 0; i < theirs.ActorCount(); ++i)
      actors.insert(theirs.ActorByIndex(i)->Name());
    std::vector<Placed> mine;
    for (const Thing& thing : ours.world.things) {
      if (actors.count(thing.name) > 0) continue;
      for (const Placed& shape : shapes_of(thing)) mine.push_back(shape);
    }
    std::size_t compared = 0;
    std::string left_out;
    for (const std::string& note : ours.notes) left_out += note;
    for (std::uint64_t i = 0; i < theirs.ModelCount(); ++i) {
      const sdf::Model& model = *theirs.ModelByIndex(i);
      std::vector<JudgedCollision> collisions;
      gather(model, resolved(model), collisions);
      for (const JudgedCollision& collision : collisions)
        for (const Placed& shape : shapes_of(collision)) {
          const auto same = std::find_if(mine.begin(), mine.end(),
                                         [&](const Placed& one) { return one.is_like(shape); });
          if (same != mine.end()) {
            mine.erase(same);
            ++compared;
            continue;
          }
          const bool is_lost_mesh =
              shape.kind == 'm' && left_out.find("LEFT OUT") != std::string::npos;
          EXPECT_TRUE(is_lost_mesh || left_out.find("'" + model.Name()) != std::string::npos)
              << where << ": " << shape.kind << " of " << model.Name() << ", "
              << shape.size.transpose() << " at\n"
              << shape.pose.matrix() << "\nis not there, and no note says so";
        }
    }
    const bool planes_left = std::all_of(mine.begin(), mine.end(), [](const Placed& shape) {
      return shape.kind == 'b' && shape.size.z() == 0.1;
    });
    EXPECT_TRUE(drops_ || planes_left) << where << ": libsdformat has fewer shapes";
    return compared;
  }

  bool drops_ = false;
};

TEST_F(Judge, agrees_with_the_worlds_that_ship) {
  EXPECT_EQ(compare(fs::path(NAVVI_SIM_DIR) / "worlds/small_room.world"), 15U);
  EXPECT_GT(compare(fs::path(NAVVI_SIM_DIR) / "worlds/crossing.sdf"), 8U);
}

TEST_F(Judge, agrees_with_small_worlds_of_every_kind) {
  write_model("cart",
              "<pose>0 0 0.2 0 0 0</pose><link name='l'><pose>1 0 0 0 0 0.5</pose><collision "
              "name='a'><pose>0 0 0.1 0 0.3 0</pose><geometry><capsule><radius>0.1</radius>"
              "<length>1</length></capsule></geometry></collision><collision name='b'><geometry>"
              "<sphere><radius>0.2</radius></sphere></geometry></collision></link>");
  write_model("pair",
              "<include><uri>model://cart</uri><name>one</name></include><include><uri>"
              "model://cart</uri><name>two</name><pose>0 2 0 0 0 1</pose></include>");
  const std::string file = write_world(
      ground_ +
          "<include><uri>model://cart</uri><name>cart_b</name><pose>3 3 1 0.1 0.2 0.3</pose>"
          "</include><include><uri>model://pair</uri><pose>-4 0 1 0 0 2</pose></include>" +
          model("crate", "<box><size>1 2 3</size></box>", "0 0 2 0 0 1"),
      "1.9");
  EXPECT_EQ(compare(file), 14U);
}

TEST_F(Judge, agrees_with_the_worlds_of_others) {
  const char* given = std::getenv("NAVVI_WORLDS");
  const fs::path folder = given != nullptr ? given : fs::path(NAVVI_SHARED_DIR) / "worlds";
  if (!fs::is_directory(folder)) GTEST_SKIP() << "there are none here";
  std::size_t worlds = 0;
  std::size_t shapes = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.path().extension() != ".world") continue;
    const std::size_t compared = compare(entry.path());
    worlds += compared > 0 ? 1 : 0;
    shapes += compared;
  }
  std::cout << shapes << " shapes of " << worlds << " worlds are as libsdformat reads them\n";
}

}  // namespace
}  // namespace navvi_sim::read

#else

TEST(Judge, agrees_with_libsdformat) { GTEST_SKIP() << "libsdformat is not installed"; }

#endif
