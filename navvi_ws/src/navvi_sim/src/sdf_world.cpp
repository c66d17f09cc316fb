#include "navvi_sim/sdf_world.hpp"

#include <cmath>
#include <map>
#include <sdf/sdf.hh>
#include <set>
#include <sstream>

#include "floor_height.hpp"
#include "navvi_sim/mesh_file.hpp"
#include "navvi_sim/model_class.hpp"
#include "sdf_files.hpp"

// The elements are walked here rather than taken from libsdformat's model classes: those leave out
// links whose masses they reject, and cannot load what Gazebo itself saved. Geometry is what
// counts.

namespace navvi_sim {
namespace {

namespace fs = std::filesystem;
using sdf::ElementPtr;

constexpr double kPlaneMargin = 2.0;     // m, of a plane beyond the other things
constexpr double kPlaneThickness = 0.1;  // m
constexpr int kMaxFrames = 64;           // in a row

/// Keeps libsdformat's talk off the terminal, and unhooks the file search in the end.
class QuietSdformat {
 public:
  explicit QuietSdformat(std::function<std::string(const std::string&)> find)
      : stream_(sdf::Console::Instance()->GetMsgStream().GetStream()) {
    sdf::Console::Instance()->GetMsgStream().SetStream(&talk_);
    sdf::setFindCallback(std::move(find));
  }
  ~QuietSdformat() {
    sdf::Console::Instance()->GetMsgStream().SetStream(stream_);
    sdf::setFindCallback([](const std::string&) { return std::string(); });
  }
  QuietSdformat(const QuietSdformat&) = delete;
  QuietSdformat& operator=(const QuietSdformat&) = delete;

  /// What libsdformat said first, without its source line; empty if it said nothing.
  [[nodiscard]] std::string first_words() const {
    std::istringstream lines(talk_.str());
    std::string line;
    std::getline(lines, line);
    const std::string plain = "\033[0m ";  // ends the coloured "Error [file:line]" in front
    const std::size_t place = line.find(plain);
    return place == std::string::npos ? line : line.substr(place + plain.size());
  }

 private:
  std::ostream* stream_;
  std::ostringstream talk_;
};

Eigen::Vector3d vector(const ignition::math::Vector3d& v) { return {v.X(), v.Y(), v.Z()}; }

Eigen::Isometry3d isometry(const ignition::math::Pose3d& pose) {
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  result.translation() = vector(pose.Pos());
  result.linear() =
      Eigen::Quaterniond(pose.Rot().W(), pose.Rot().X(), pose.Rot().Y(), pose.Rot().Z())
          .normalized()
          .toRotationMatrix();
  return result;
}

/// Calls `visit` with each child element of that name.
template <typename Visit>
void for_each(const ElementPtr& parent, const std::string& name, const Visit& visit) {
  if (!parent->HasElement(name)) return;
  for (ElementPtr child = parent->GetElement(name); child; child = child->GetNextElement(name))
    visit(child);
}

std::string attribute(const ElementPtr& element, const std::string& key) {
  return element->HasAttribute(key) ? element->Get<std::string>(key) : "";
}

std::string name_of(const ElementPtr& element) { return attribute(element, "name"); }

class WorldReader {
 public:
  WorldReader(fs::path file, const SdfFiles& files) : file_(std::move(file)), files_(files) {}

  [[nodiscard]] LoadedWorld read(const ElementPtr& world) {
    loaded_.world.name = name_of(world).empty() ? file_.stem().string() : name_of(world);
    read_saved_state(world);
    for_each(world, "model", [&](const ElementPtr& model) { read_model(world, model); });
    for_each(world, "actor", [&](const ElementPtr& actor) {
      note("the actor '" + name_of(actor) +
           "' is not taken over: actors have no collision geometry");
    });
    for (const char* word : {"road", "population"})
      for_each(world, word, [&](const ElementPtr& element) {
        note("the " + std::string(word) + " '" + name_of(element) + "' is not taken over");
      });
    add_planes();
    find_floor();
    return std::move(loaded_);
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const {
    throw WorldError(file_.string() + ": " + what);
  }
  void note(const std::string& sentence) { loaded_.notes.push_back(sentence); }

  // -- Frames. A pose is relative to the element around it, or to what `relative_to` names there.

  [[nodiscard]] ElementPtr child_named(const ElementPtr& scope, const std::string& name) const {
    for (const char* word : {"model", "link", "frame", "joint"}) {
      ElementPtr found;
      for_each(scope, word, [&](const ElementPtr& child) {
        if (!found && name_of(child) == name) found = child;
      });
      if (found) return found;
    }
    return nullptr;
  }

  /// The pose of the frame `name` in `scope`, "a::b" being b in a.
  [[nodiscard]] Eigen::Isometry3d frame_named(const ElementPtr& scope, const std::string& name,
                                              int depth) const {
    if (depth > kMaxFrames) refuse("the frame '" + name + "' depends on itself");
    if (name == "world" || name == "__model__") return Eigen::Isometry3d::Identity();
    if (const ElementPtr child = child_named(scope, name)) return pose_in(scope, child, depth + 1);
    const std::size_t split = name.find("::");
    if (split != std::string::npos)
      if (const ElementPtr outer = child_named(scope, name.substr(0, split)))
        return pose_in(scope, outer, depth + 1) *
               frame_named(outer, name.substr(split + 2), depth + 1);
    refuse("a pose in '" + name_of(scope) + "' is relative to '" + name +
           "'; allowed are models, links, frames and joints of the same element");
  }

  /// The pose of `element`, a child of `scope`, in the frame of `scope`.
  [[nodiscard]] Eigen::Isometry3d pose_in(const ElementPtr& scope, const ElementPtr& element,
                                          int depth = 0) const {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    std::string base;
    if (element->HasElement("pose")) {
      const ElementPtr value = element->GetElement("pose");
      pose = isometry(value->Get<ignition::math::Pose3d>());
      base = attribute(value, "relative_to");
    }
    if (base.empty() && element->GetName() == "frame") base = attribute(element, "attached_to");
    if (base.empty() && element->GetName() == "joint" && element->HasElement("child"))
      base = element->GetElement("child")->Get<std::string>();
    if (!pose.matrix().allFinite())
      refuse("'" + name_of(element) + "' has a pose that is not finite");
    if (base.empty()) return pose;
    return frame_named(scope, base, depth) * pose;
  }

  // -- Models

  /// Gazebo puts the models of a saved world where its <state> says.
  void read_saved_state(const ElementPtr& world) {
    for_each(world, "state", [&](const ElementPtr& state) {
      for_each(state, "model", [&](const ElementPtr& model) {
        if (model->HasElement("pose"))
          saved_poses_[name_of(model)] =
              isometry(model->GetElement("pose")->Get<ignition::math::Pose3d>());
      });
    });
    if (!saved_poses_.empty()) note("models stand where the world's saved state says");
  }

  void read_model(const ElementPtr& world, const ElementPtr& model) {
    Thing thing;
    thing.name = unique(name_of(model));
    thing.thing_class = class_of_model(name_of(model));
    const auto saved = saved_poses_.find(name_of(model));
    thing.pose = saved != saved_poses_.end() ? saved->second : pose_in(world, model);
    const std::size_t planes = planes_.size();
    read_links(model, Eigen::Isometry3d::Identity(), thing);
    if (!attribute(model, "placement_frame").empty())
      note("'" + thing.name + "' asks for a placement frame, which is not taken over");
    if (!thing.shapes.empty()) {
      loaded_.world.things.push_back(std::move(thing));
      return;
    }
    names_.erase(thing.name);
    if (planes == planes_.size())
      note("the model '" + thing.name + "' is not taken over: it has no collision geometry");
  }

  std::string unique(const std::string& name) {
    const std::string base = name.empty() ? "unnamed" : name;
    std::string result = base;
    for (int i = 2; !names_.insert(result).second; ++i) result = base + "#" + std::to_string(i);
    return result;
  }

  /// \param pose  of `model` in the thing's frame
  void read_links(const ElementPtr& model, const Eigen::Isometry3d& pose, Thing& thing) {
    for_each(model, "link", [&](const ElementPtr& link) {
      const Eigen::Isometry3d link_pose = pose * pose_in(model, link);
      for_each(link, "collision", [&](const ElementPtr& collision) {
        read_collision(collision, link_pose * collision_pose(model, link, collision), thing);
      });
    });
    for_each(model, "model", [&](const ElementPtr& inner) {
      if (thing.thing_class == ThingClass::other)
        thing.thing_class = class_of_model(name_of(inner));
      read_links(inner, pose * pose_in(model, inner), thing);
    });
  }

  /// A collision's relative_to names a frame of the model around its link.
  [[nodiscard]] Eigen::Isometry3d collision_pose(const ElementPtr& model, const ElementPtr& link,
                                                 const ElementPtr& collision) const {
    if (!collision->HasElement("pose") ||
        attribute(collision->GetElement("pose"), "relative_to").empty())
      return pose_in(link, collision);
    return pose_in(model, link).inverse() * pose_in(model, collision);
  }

  // -- Geometry

  void read_collision(const ElementPtr& collision, const Eigen::Isometry3d& pose, Thing& thing) {
    const std::string who = "'" + thing.name + "'";
    if (!collision->HasElement("geometry")) {
      note(who + " has a collision without geometry, which is not taken over");
      return;
    }
    const ElementPtr geometry = collision->GetElement("geometry");
    const auto add = [&](Geometry shape) { thing.shapes.push_back({std::move(shape), pose}); };
    if (geometry->HasElement("box")) {
      add(Box{vector(geometry->GetElement("box")->Get<ignition::math::Vector3d>("size"))});
    } else if (geometry->HasElement("cylinder")) {
      const ElementPtr cylinder = geometry->GetElement("cylinder");
      add(Cylinder{cylinder->Get<double>("radius"), cylinder->Get<double>("length")});
    } else if (geometry->HasElement("sphere")) {
      add(Sphere{geometry->GetElement("sphere")->Get<double>("radius")});
    } else if (geometry->HasElement("mesh")) {
      read_mesh_shape(geometry->GetElement("mesh"), pose, thing);
    } else if (geometry->HasElement("plane")) {
      read_plane(geometry->GetElement("plane"), pose, thing);
    } else {
      const ElementPtr kind = geometry->GetFirstElement();
      note(who + " has the shape '" + (kind ? kind->GetName() : "none") +
           "', which is not taken over; known are box, cylinder, sphere, mesh, plane");
    }
  }

  void read_mesh_shape(const ElementPtr& mesh, const Eigen::Isometry3d& pose, Thing& thing) {
    const std::string uri = mesh->Get<std::string>("uri");
    if (mesh->HasElement("submesh")) {
      note("'" + thing.name + "' uses a part of the mesh " + uri + ", which is not taken over");
      return;
    }
    const fs::path from = mesh->FilePath().empty() ? file_ : fs::path(mesh->FilePath());
    const auto found = files_.find(uri, from);
    if (!found)
      refuse("the mesh " + uri + " of '" + thing.name + "' is not there; looked in " +
             files_.looked_in() + " (give its folder as models)");
    Eigen::Vector3d scale = Eigen::Vector3d::Ones();
    if (mesh->HasElement("scale")) scale = vector(mesh->Get<ignition::math::Vector3d>("scale"));
    std::ostringstream key;
    key << found->string() << '|' << scale.transpose();
    auto& shared = meshes_[key.str()];
    if (!shared) shared = std::make_shared<const Mesh>(read_mesh(*found, scale));
    thing.shapes.push_back({shared, pose});
  }

  void read_plane(const ElementPtr& plane, const Eigen::Isometry3d& pose, const Thing& thing) {
    Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
    if (plane->HasElement("normal"))
      normal = vector(plane->Get<ignition::math::Vector3d>("normal"));
    const Eigen::Isometry3d in_map = thing.pose * pose;
    if (!((in_map.linear() * normal.normalized()).z() > 0.999)) {
      note("'" + thing.name + "' has a plane that is not level, which is not taken over");
      return;
    }
    planes_.push_back({thing.name, in_map.translation().z()});
  }

  /// A plane has no end; the floor made of it goes as far as the other things do, and some more.
  void add_planes() {
    for (const Plane& plane : planes_) {
      Eigen::AlignedBox3d bounds = bounds_of(loaded_.world.things);
      if (bounds.isEmpty())
        bounds.extend(Eigen::Vector3d(-10, -10, 0)).extend(Eigen::Vector3d(10, 10, 0));
      const Eigen::Vector3d size = bounds.sizes() + Eigen::Vector3d::Constant(2.0 * kPlaneMargin);
      Thing thing;
      thing.name = names_.count(plane.name) ? unique(plane.name + "_plane") : unique(plane.name);
      thing.thing_class = ThingClass::floor;
      thing.pose.translation() = Eigen::Vector3d(bounds.center().x(), bounds.center().y(),
                                                 plane.height - kPlaneThickness / 2.0);
      thing.shapes.push_back(
          {Box{{size.x(), size.y(), kPlaneThickness}}, Eigen::Isometry3d::Identity()});
      std::ostringstream sentence;
      sentence << "the endless plane '" << plane.name << "' becomes a floor of " << size.x()
               << " x " << size.y() << " m";
      note(sentence.str());
      loaded_.world.things.push_back(std::move(thing));
    }
  }

  void find_floor() {
    std::vector<Thing>& things = loaded_.world.things;
    const auto height = main_floor_height(things);
    if (!height)
      refuse(
          "no model is a floor with a level surface; the floor's model must have ground or "
          "floor in its name, or a plane for its collision");
    loaded_.world.floor_height = *height;
    std::vector<Thing> kept;
    for (Thing& thing : things) {
      if (thing.thing_class != ThingClass::floor && top_of(thing) < *height)
        note("the model '" + thing.name + "' is not taken over: all of it lies under the floor");
      else
        kept.push_back(std::move(thing));
    }
    things = std::move(kept);
  }

  struct Plane {
    std::string name;
    double height;  ///< m, in map
  };

  fs::path file_;
  const SdfFiles& files_;
  LoadedWorld loaded_;
  std::set<std::string> names_;
  std::vector<Plane> planes_;
  std::map<std::string, Eigen::Isometry3d> saved_poses_;
  std::map<std::string, std::shared_ptr<const Mesh>> meshes_;
};

sdf::SDFPtr parse(const fs::path& file, const QuietSdformat& quiet) {
  const auto document = std::make_shared<sdf::SDF>();
  sdf::Errors errors;
  bool read = false;
  try {
    sdf::init(document);
    read = sdf::readFileWithoutConversion(fs::absolute(file).string(), document, errors);
  } catch (const WorldError&) {
    throw;
  } catch (const std::exception& error) {
    throw WorldError(file.string() + ": cannot be read as SDF: " + error.what());
  } catch (...) {  // libsdformat's own assertions are no std::exception
    throw WorldError(file.string() + ": cannot be read as SDF: libsdformat gave up on it");
  }
  const bool has_world = document->Root() && document->Root()->HasElement("world");
  if (!read || !has_world) {
    std::string why = errors.empty() ? quiet.first_words() : errors.front().Message();
    if (read || why.empty()) why = "it has no <world>";
    throw WorldError(file.string() + ": is no SDF world (" + why +
                     "); allowed is an <sdf> element with one <world> in it");
  }
  return document;
}

}  // namespace

LoadedWorld read_sdf_world(const fs::path& file, const std::vector<fs::path>& models) {
  const SdfFiles files(file, models);
  files.check_includes();
  const QuietSdformat quiet([&](const std::string& uri) {
    const auto found = files.find(uri, file);
    return found ? found->string() : std::string();
  });
  const sdf::SDFPtr document = parse(file, quiet);
  return WorldReader(file, files).read(document->Root()->GetElement("world"));
}

}  // namespace navvi_sim
