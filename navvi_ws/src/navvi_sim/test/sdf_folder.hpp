#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <string>

#include "navvi_sim/read/world_source.hpp"
#include "temp_folder.hpp"

namespace navvi_sim::read {

inline const Thing* thing_named(const WorldDescription& world, const std::string& name) {
  for (const Thing& thing : world.things)
    if (thing.name == name) return &thing;
  return nullptr;
}

/// Of meshes, boxes, cylinders and spheres that stand along the axes, in map.
inline Eigen::AlignedBox3d bounds(const Thing& thing) {
  Eigen::AlignedBox3d result;
  for (const Shape& shape : thing.shapes) {
    const Eigen::Isometry3d pose = thing.pose * shape.pose;
    if (const auto* mesh = std::get_if<std::shared_ptr<const Mesh>>(&shape.geometry))
      for (const Eigen::Vector3f& vertex : (*mesh)->vertices)
        result.extend(pose * vertex.cast<double>());
    if (const auto* cylinder = std::get_if<Cylinder>(&shape.geometry)) {
      const Eigen::Vector3d reach(cylinder->radius, cylinder->radius, cylinder->length / 2.0);
      result.extend(pose.translation() + reach).extend(pose.translation() - reach);
    }
    if (const auto* sphere = std::get_if<Sphere>(&shape.geometry)) {
      const Eigen::Vector3d reach = Eigen::Vector3d::Constant(sphere->radius);
      result.extend(pose.translation() + reach).extend(pose.translation() - reach);
    }
    if (const Box* box = std::get_if<Box>(&shape.geometry)) {
      const Eigen::Vector3d reach = pose.linear().cwiseAbs() * box->size / 2.0;
      result.extend(pose.translation() + reach).extend(pose.translation() - reach);
    }
  }
  return result;
}

inline std::string sentence_of(const std::string& spec, const std::string& models = "") {
  try {
    static_cast<void>(load_world({spec, models}));
  } catch (const WorldError& error) {
    return error.what();
  }
  return "";
}

/// A folder for the worlds of one test, gone afterwards.
class SdfFolder : public testing::Test {
 protected:
  std::string write(const std::filesystem::path& name, const std::string& text) const {
    return folder_.write(name, text);
  }
  std::string write_world(const std::string& body, const std::string& version = "1.6") const {
    return write("a.world", "<?xml version='1.0'?><sdf version='" + version + "'><world name='w'>" +
                                body + "</world></sdf>");
  }
  void write_model(const std::string& name, const std::string& body) const {
    write("models/" + name + "/model.config",
          "<?xml version='1.0'?><model><name>m</name><sdf version='1.6'>model.sdf</sdf></model>");
    write("models/" + name + "/model.sdf", "<?xml version='1.0'?><sdf version='1.6'><model name='" +
                                               name + "'>" + body + "</model></sdf>");
  }

  navvi_test::TempFolder folder_;
  [[nodiscard]] LoadedWorld load(const std::string& body,
                                 const std::string& version = "1.6") const {
    return load_world({write_world(body, version)});
  }
  [[nodiscard]] LoadedWorld load_leaving_out(const std::string& body) const {
    return load_world({write_world(body), "", 1, Workers::as_laid_out, "", Missing::leave_out});
  }
  /// A model of one link with one collision of that geometry.
  [[nodiscard]] static std::string model(const std::string& name, const std::string& geometry,
                                         const std::string& pose = "0 0 0 0 0 0") {
    return "<model name='" + name + "'><pose>" + pose +
           "</pose><link name='l'><collision name='c'><geometry>" + geometry +
           "</geometry></collision></link></model>";
  }

  const std::string ground_ =
      "<model name='ground'><link name='l'><collision name='c'><pose>0 0 -0.05 0 0 0</pose>"
      "<geometry><box><size>20 20 0.1</size></box></geometry></collision></link></model>";
  const std::string cube_ =
      "<link name='l'><collision name='c'><geometry><box><size>1 1 1</size></box></geometry>"
      "</collision></link>";
};

/// Whether one of the notes has all of these words.
inline bool has_note(const LoadedWorld& loaded, const std::vector<std::string>& words) {
  for (const std::string& note : loaded.notes) {
    bool all = true;
    for (const std::string& word : words) all = all && note.find(word) != std::string::npos;
    if (all) return true;
  }
  return false;
}

}  // namespace navvi_sim::read
