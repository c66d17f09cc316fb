#include "read/sdf_world.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "description/sentence.hpp"
#include "description/validate.hpp"
#include "generate/furniture.hpp"
#include "read/sdf_files.hpp"
#include "read/sdf_geometry.hpp"
#include "read/sdf_motion.hpp"
#include "read/sdf_own.hpp"
#include "read/sdf_things.hpp"
#include "read/sdf_value.hpp"

namespace navvi_sim::read {
namespace {

namespace fs = std::filesystem;

constexpr double kSamePose = 1e-4;  // m or of a rotation: saved poses are rounded

/// The same place and heading, upright.
Eigen::Isometry3d upright(const Eigen::Isometry3d& pose) {
  const Eigen::Vector3d at = pose.translation();
  return generate::at(at.x(), at.y(), at.z(), std::atan2(pose.linear()(1, 0), pose.linear()(0, 0)));
}

/// Whether a child says so, in any spelling: what is misspelt here moves nothing.
bool says(const XmlElement& element, const char* child, const char* word, const char* digit) {
  const std::string text = lower_case(element.text_of(child));
  return text == word || text == digit;
}

/// Whether a model stays where it is put, whatever carries it.
bool is_held(const XmlElement& model) {
  if (says(model, "static", "true", "1") || model.child("joint") != nullptr) return true;
  for (const XmlElement* link : model.children_named("link"))
    if (says(*link, "gravity", "false", "0") || says(*link, "kinematic", "true", "1")) return true;
  const auto inner = model.children_named("model");
  return std::any_of(inner.begin(), inner.end(),
                     [](const XmlElement* one) { return is_held(*one); });
}

bool has_collision(const XmlElement& model) {
  const auto links = model.children_named("link");
  return std::any_of(links.begin(), links.end(),
                     [](const XmlElement* link) { return link->child("collision") != nullptr; });
}

/// Whether Gazebo lets everything pass through it.
bool touches_nothing(const XmlElement& collision) {
  const XmlElement* inner = collision.child("surface");
  if (inner != nullptr) inner = inner->child("contact");
  const std::string mask = inner == nullptr ? "" : inner->text_of("collide_bitmask");
  return !mask.empty() && mask.find_first_not_of("0x") == std::string::npos;
}

std::string name_of(const XmlElement& element) { return element.attribute("name"); }

class WorldReader {
 public:
  WorldReader(const fs::path& file, SdfFiles& files, const ClassRules& rules, Missing missing)
      : file_(file),
        files_(files),
        rules_(rules),
        notes_(missing),
        shapes_(files),
        things_(notes_) {}

  [[nodiscard]] LoadedWorld read() {
    const XmlElement world = files_.world(notes_);
    LoadedWorld& loaded = things_.loaded;
    loaded.world.name = name_of(world).empty() ? file_.stem().string() : shortened(name_of(world));
    const std::string gravity = world.text_of("gravity");
    weightless_ = !gravity.empty() && gravity.find_first_of("123456789") == std::string::npos;
    for (const XmlElement* state : world.children_named("state")) keep_state(*state, world);
    notes_.add_leftovers(world);
    for (const XmlElement* model : world.children_named("model"))
      notes_.piece(name_of(*model),
                   [&] { read_model(*model, name_of(*model), map_pose(world, *model)); });
    for (const XmlElement* actor : world.children_named("actor"))
      notes_.piece(name_of(*actor), [&] { read_actor(*actor, map_pose(world, *actor)); });
    notes_.refuse_faults();
    say_what_was_saved(world);
    things_.find_floor(file_);
    if (has_foreign_routes_) keep_routes_that_can_be_driven(loaded.world, things_.places(), notes_);
    files_.note_repairs(notes_);
    loaded.notes = notes_.sentences();
    return std::move(loaded);
  }

 private:
  // -- The state of a world that Gazebo saved

  /// What a <state> says of the models and links in `scope`, and of those in them.
  void keep_state(const XmlElement& state, const XmlElement& scope) {
    std::map<std::pair<std::string, std::string>, const XmlElement*> named;
    for (const XmlElement& element : scope.children)
      named.emplace(std::pair(element.name == "actor" ? "model" : element.name, name_of(element)),
                    &element);
    for (const XmlElement& saved : state.children) {
      const auto element = named.find({saved.name, name_of(saved)});
      if (saved.name == "insertions" || (saved.name == "model" && element == named.end()))
        notes_.add(saved, "the saved state has " +
                              (saved.name == "model" ? "the model '" + name_of(saved) + "'"
                                                     : std::string("<insertions>")) +
                              ", which the world lacks, and which is not taken over");
      if (element == named.end() || (saved.name != "model" && saved.name != "link")) continue;
      saved_[element->second] = &saved;
      keep_state(saved, *element->second);
    }
  }

  [[nodiscard]] const XmlElement* saved(const XmlElement& element, const char* what) const {
    const auto found = saved_.find(&element);
    return found == saved_.end() ? nullptr : found->second->child(what);
  }

  /// As Gazebo's SetState does, which puts each model and link where its state says, in map.
  /// \param frame  in map; that of the result
  /// \param pose   of `scope` in `frame`
  [[nodiscard]] Eigen::Isometry3d pose_of(const XmlElement& scope, const XmlElement& element,
                                          const Eigen::Isometry3d& frame,
                                          const Eigen::Isometry3d& pose) {
    const Eigen::Isometry3d in_file = pose * pose_in(scope, element);
    const XmlElement* value = saved(element, "pose");
    if (value == nullptr) return in_file;
    const Eigen::Isometry3d there = frame.inverse() * pose_value(*value);
    if ((there.matrix() - in_file.matrix()).cwiseAbs().maxCoeff() < kSamePose) return in_file;
    ++moved_;
    return there;
  }
  [[nodiscard]] Eigen::Isometry3d map_pose(const XmlElement& world, const XmlElement& element) {
    return pose_of(world, element, Eigen::Isometry3d::Identity(), Eigen::Isometry3d::Identity());
  }

  [[nodiscard]] Eigen::Vector3d scale_of(const XmlElement& model) {
    const XmlElement* scale = saved(model, "scale");
    if (scale == nullptr) return Eigen::Vector3d::Ones();
    const Eigen::Vector3d value = vector3(*scale);
    if (!(value.minCoeff() > 0.0))
      refuse(*scale, "the <scale> of '" + name_of(model) + "' is \"" + scale->text +
                         "\"; allowed are numbers above 0");
    if (!value.isOnes()) ++scaled_;
    return value;
  }

  void say_what_was_saved(const XmlElement& world) {
    if (moved_ + scaled_ > 0)
      notes_.add(*world.child("state"), "the saved state moves " + std::to_string(moved_) +
                                            " models and links, and scales " +
                                            std::to_string(scaled_) + " models");
  }

  // -- Models and actors

  /// \param pose  in map
  /// \param held  by a model around it
  void read_model(const XmlElement& model, const std::string& name, const Eigen::Isometry3d& pose,
                  bool held = false) {
    held = held || weightless_ || is_held(model);
    const auto inner = model.children_named("model");
    if (inner.size() > 1 && !has_collision(model)) {
      notes_.add_leftovers(model);
      for (const XmlElement* one : inner)
        notes_.piece(name + "::" + name_of(*one), [&] {
          read_model(*one, name + "::" + name_of(*one),
                     pose * pose_of(model, *one, pose, Eigen::Isometry3d::Identity()), held);
        });
      return;
    }
    Thing thing;
    thing.name = things_.unique(name);
    thing.pose = pose;
    classify(model, thing);
    const std::size_t planes = things_.planes();
    read_links(model, Eigen::Isometry3d::Identity(), thing);
    thing.route = own_route(model);
    if (!thing.shapes.empty()) {
      check(thing, model);
      if (!held) things_.set_loose(thing.name);
      things_.add(std::move(thing), model.place());
      return;
    }
    things_.release(thing.name);
    if (planes == things_.planes())
      notes_.add(model,
                 "the model '" + thing.name + "' is not taken over: it has no collision geometry");
  }

  /// \param pose  in map
  void read_actor(const XmlElement& actor, const Eigen::Isometry3d& pose) {
    Thing thing;
    thing.name = things_.unique(name_of(actor));
    classify(actor, thing);
    if (thing.thing_class == ThingClass::other || thing.thing_class == ThingClass::floor)
      thing.thing_class = ThingClass::worker;
    // Gazebo saves a small collision for each bone, in the pose of the skin's file.
    thing.pose = pose;
    if (actor.child("skin") == nullptr)
      read_links(actor, Eigen::Isometry3d::Identity(), thing);
    else
      notes_.add_leftovers(actor);
    if (thing.shapes.empty() && actor.child("link") != nullptr)
      notes_.add(actor, "the bones of '" + thing.name + "' are left out: a person of " +
                            "1.75 m stands for them");
    const SdfMotion motion = actor_motion(actor, pose, notes_);
    thing.pose = motion.start;
    thing.route = motion.route;
    has_foreign_routes_ = true;
    if (thing.shapes.empty()) {
      thing.shapes = generate::worker().shapes;
      thing.pose = upright(thing.pose);
      check(thing, actor);
      things_.add_on_floor(std::move(thing), actor.place());
    } else {
      check(thing, actor);
      things_.add(std::move(thing), actor.place());
    }
  }

  static void check(const Thing& thing, const XmlElement& element) {
    try {
      validate(thing);
    } catch (const WorldError& error) {
      refuse(element, error.what());
    }
  }

  void classify(const XmlElement& model, Thing& thing) {
    if (const auto own = own_class(model, "class")) {
      thing.thing_class = *own;
      return;
    }
    const auto match = match_names(model, thing.name, std::nullopt);
    if (!match) return;
    thing.thing_class = *match;
    if (match == ThingClass::floor)
      things_.set_class_if_no_floor(
          thing.name,
          match_names(model, thing.name, ThingClass::floor).value_or(ThingClass::other));
  }

  /// The first rule that fits the thing, or else a model or link in it.
  [[nodiscard]] std::optional<ThingClass> match_names(const XmlElement& model,
                                                      const std::string& thing,
                                                      std::optional<ThingClass> not_this) const {
    std::vector<std::string> names{thing};
    for (const char* kind : {"model", "link"})
      for (const XmlElement* inner : model.children_named(kind)) names.push_back(name_of(*inner));
    for (const std::string& name : names)
      if (const auto match = rules_.match(name, not_this)) return match;
    return std::nullopt;
  }

  // -- Links

  /// \param pose  of `model` in the thing's frame
  void read_links(const XmlElement& model, const Eigen::Isometry3d& pose, Thing& thing) {
    notes_.add_leftovers(model);
    const Eigen::Vector3d scale = scale_of(model);
    for (const XmlElement* link : model.children_named("link")) {
      notes_.add_leftovers(*link);
      const Eigen::Isometry3d link_pose = pose_of(model, *link, thing.pose, pose);
      for (const XmlElement* collision : link->children_named("collision"))
        notes_.piece(thing.name, [&] {
          const Eigen::Isometry3d in_link = pose_in_link(model, *link, *collision);
          read_collision(*collision, link_pose * in_link, scale, thing);
        });
      const std::size_t seen = link->children_named("visual").size();
      if (seen > 0 && link->child("collision") == nullptr && has_collision(model))
        notes_.add(*link, "the link '" + name_of(*link) + "' of '" + thing.name +
                              "' is seen in "
                              "Gazebo and touches nothing, and is not taken over");
    }
    for (const XmlElement* inner : model.children_named("model"))
      read_links(*inner, pose_of(model, *inner, thing.pose, pose), thing);
  }

  void read_collision(const XmlElement& collision, const Eigen::Isometry3d& pose,
                      const Eigen::Vector3d& scale, Thing& thing) {
    const XmlElement* geometry = collision.child("geometry");
    if (geometry == nullptr) {
      notes_.add(collision, "a collision of '" + thing.name + "' without geometry is left out");
      return;
    }
    if (touches_nothing(collision)) {
      notes_.add(collision, "a collision of '" + thing.name +
                                "' with a <collide_bitmask> of 0 touches nothing, and is left out");
      return;
    }
    SdfGeometry read = shapes_.read(*geometry, pose, scale);
    if (geometry->children.size() > 1)
      notes_.add(*geometry, "a <geometry> of '" + thing.name +
                                "' has several shapes, and one is allowed; all are taken");
    const std::optional<ThingClass> look = own_class(collision, "look");
    for (Shape& shape : read.shapes) {
      shape.look = look;
      thing.shapes.push_back(std::move(shape));
    }
    if (thing.shapes.size() > WorldLimits::shapes_per_thing)
      refuse(collision, "'" + thing.name + "' has more than " +
                            std::to_string(WorldLimits::shapes_per_thing) +
                            " shapes; allowed is up to that");
    for (const SdfPlane& plane : read.planes) {
      const Eigen::Isometry3d in_map = thing.pose * plane.pose;
      if ((in_map.linear() * plane.normal.normalized()).z() > 0.999)
        things_.add_plane(thing.name, in_map.translation().z(), geometry->place());
      else
        notes_.add(*geometry,
                   "the plane of '" + thing.name + "' is not level, and is not taken over");
    }
  }

  const fs::path& file_;
  SdfFiles& files_;
  const ClassRules& rules_;
  SdfNotes notes_;
  SdfShapes shapes_;
  SdfThings things_;
  bool has_foreign_routes_ = false;                       ///< given by an actor
  bool weightless_ = false;                               ///< there is no gravity
  std::map<const XmlElement*, const XmlElement*> saved_;  ///< states, by what they are of
  int moved_ = 0;
  int scaled_ = 0;
};

}  // namespace

LoadedWorld read_sdf_world(const fs::path& file, const ModelPlaces& places, const ClassRules& rules,
                           Missing missing) {
  SdfFiles files(file, places);
  return WorldReader(file, files, rules, missing).read();
}

}  // namespace navvi_sim::read
