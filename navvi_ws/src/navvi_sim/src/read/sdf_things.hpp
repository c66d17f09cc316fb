#pragma once

#include <cstddef>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "navvi_sim/read/world_source.hpp"
#include "read/sdf_notes.hpp"

namespace navvi_sim::read {

/// The things of an SDF world, collected one by one, and then the floor under them.
class SdfThings {
 public:
  explicit SdfThings(SdfNotes& notes) : notes_(notes) {}

  /// `name`, or `name#2` and so on where it is taken. It is taken from then on.
  [[nodiscard]] std::string unique(const std::string& name);
  /// The name of what is not added after all.
  void release(const std::string& name) { names_.erase(name); }

  /// \param place  where it stands in its file
  void add(Thing thing, const std::string& place);
  /// What is put on the floor, wherever that is.
  void add_on_floor(Thing thing, const std::string& place);
  /// A level plane: it becomes a floor under all things.
  /// \param height  m, in map
  void add_plane(const std::string& name, double height, const std::string& place);
  [[nodiscard]] std::size_t planes() const { return planes_.size(); }

  /// Adds the planes, finds the floor's height, and leaves out what lies under it.
  /// \throws WorldError that begins with `file` if no thing is a floor
  void find_floor(const std::filesystem::path& file);

  LoadedWorld loaded;
  /// Of each thing in `loaded`.
  [[nodiscard]] const std::vector<std::string>& places() const { return places_; }

 private:
  struct Plane {
    std::string name;
    double height;  ///< m, in map
    std::string place;
  };

  void add_planes();
  void leave_out_what_is_under(double height);

  SdfNotes& notes_;
  std::vector<std::string> places_;
  std::set<std::string> names_;
  std::vector<Plane> planes_;
  std::vector<std::size_t> on_floor_;  ///< things
};

}  // namespace navvi_sim::read
