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

inline std::string repeated(const std::string& text, int count) {
  std::string result;
  for (int i = 0; i < count; ++i) result += text;
  return result;
}

/// With `to` for the first `from`.
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

/// Collada with one triangle, geometry g.
inline std::string collada(const std::string& library, const std::string& scene) {
  return "<?xml version='1.0'?><COLLADA xmlns='http://www.collada.org/2005/11/COLLADASchema' "
         "version='1.4.1'><asset><unit meter='1'/><up_axis>Z_UP</up_axis></asset>"
         "<library_geometries><geometry id='g'><mesh><source id='p'><float_array id='a' count='9'>"
         "0 0 0 1 0 0 0 1 0</float_array><technique_common><accessor source='#a' count='3' "
         "stride='3'><param name='X' type='float'/><param name='Y' type='float'/><param name='Z' "
         "type='float'/></accessor></technique_common></source><vertices id='v'><input "
         "semantic='POSITION' source='#p'/></vertices><triangles count='1'><input offset='0' "
         "semantic='VERTEX' source='#v'/><p>0 1 2</p></triangles></mesh></geometry>"
         "</library_geometries>" +
         library + "<library_visual_scenes><visual_scene id='s'>" + scene +
         "</visual_scene></library_visual_scenes><scene><instance_visual_scene url='#s'/></scene>"
         "</COLLADA>";
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
  /// \param size, at  m
  [[nodiscard]] static std::string box(const std::string& name, const std::string& size,
                                       const std::string& at = "0 0 0") {
    return model(name, "<box><size>" + size + "</size></box>", at + " 0 0 0");
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
