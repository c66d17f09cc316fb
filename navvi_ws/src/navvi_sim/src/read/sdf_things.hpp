#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "navvi_sim/read/loaded_world.hpp"
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
  /// Notes that a thing is neither static nor held by a joint: gravity moves it if nothing carries
  /// it.
  void set_loose(const std::string& thing) { loose_.insert(thing); }
  /// What is put on the floor, wherever that is.
  void add_on_floor(Thing thing, const std::string& place);
  /// A level plane: it becomes a floor under all things.
  /// \param height  m, in map
  void add_plane(const std::string& name, double height, const std::string& place);
  [[nodiscard]] std::size_t planes() const { return planes_.size(); }

  /// \param what  the rules call the thing, named a floor, should it turn out to be none
  void set_class_if_no_floor(const std::string& thing, ThingClass what) {
    if_no_floor_[thing] = what;
  }

  /// Adds the planes, finds the floor's height, gives another class to what a rule calls a floor
  /// and is none, leaves out what lies under the floor and on storeys above, and names what hangs
  /// in the air. \throws WorldError that begins with `file` if no thing is a floor, it
  /// carries little of what stands, or too much lies under it
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

  struct Lost {
    std::string name;
    std::string place;
  };

  void add_planes();
  [[noreturn]] void refuse_width(double width) const;
  [[noreturn]] void refuse_floor(const std::filesystem::path& file, const std::string& why) const;
  void find_floor_of_buildings();
  void judge_floors(double height);
  void judge_terrain(double height, const std::filesystem::path& file);
  /// Takes some things out. \param why  of a note on each; empty: none is made
  std::vector<Lost> leave_out(const std::function<bool(const Thing&)>& is_lost,
                              const std::string& why = "");
  void leave_out_what_is_under(double height, const std::filesystem::path& file);
  void leave_out_spares(double height);
  void leave_out_what_is_in_slabs(double height);
  /// With all that is above it.
  void leave_out_storey(double storey);
  void judge_what_stands(double height, const std::filesystem::path& file);
  void name_what_hangs();

  SdfNotes& notes_;
  std::vector<std::string> places_;
  std::set<std::string> names_;
  std::set<std::string> loose_;  ///< things
  std::vector<Plane> planes_;
  std::map<std::string, ThingClass> if_no_floor_;  ///< by thing
  std::vector<std::size_t> on_floor_;              ///< things
};

}  // namespace navvi_sim::read
