#pragma once

#include <navvi_config/field.hpp>
#include <optional>
#include <string>
#include <vector>

#include "navvi_sim/description/world_description.hpp"

namespace navvi_sim::generate {

/// What a warehouse is built from. Shelf rows, each of two racks back to back, run from the docks
/// in the south to the back of the hall, with an aisle on either side of each; cross-aisles cut
/// them into blocks. Every field that counts something is met exactly or the layout is refused. The
/// defaults are the preset `easy`.
struct LayoutConfig {
  double length = 34.0;             ///< m, of the hall along the dock wall (x), inside
  double width = 27.0;              ///< m, of the hall away from the dock wall (y), inside
  int rows = 0;                     ///< shelf rows; 0: as many as fit
  int blocks = 0;                   ///< shelf blocks behind each other; 0: as many as fit
  int bays = 3;                     ///< 2 m each, in a rack of a block; 0: as many as fit
  double aisle = 3.2;               ///< m, between two rows
  double cross_aisle = 3.4;         ///< m, before, between and behind the blocks
  double dead_ends = 0.0;           ///< share, of the ways that can be closed with none cut off
  int docks = 3;                    ///< each at the end of an aisle
  int walls = 0;                    ///< through the hall from front to back
  double door = 2.4;                ///< m, of the walls, one a cross-aisle
  double fill = 0.6;                ///< share of shelf places that hold a box
  double staged = 0.5;              ///< share of the places at the docks that hold a loaded pallet
  double pallets = 0.0;             ///< share of places in quiet aisles with a pallet left there
  double pedestals = 0.1;           ///< likewise, with a pedestal
  double clutter = 0.05;            ///< likewise, with boxes
  double pedestal_min = 0.05;       ///< m, least height of a pedestal
  double pedestal_max = 0.30;       ///< m, greatest
  int forklifts = 1;                ///< on routes
  int pallet_robots = 1;            ///< on routes
  int walking_workers = 2;          ///< workers on routes
  int standing_workers = 1;         ///< workers without a route
  double forklift_speed = 1.0;      ///< m/s, of forklifts on their routes
  double pallet_robot_speed = 0.7;  ///< m/s, of pallet robots on their routes
  double worker_speed = 0.8;        ///< m/s, of workers who walk
  double pause = 4.0;               ///< s, of what moves, at docks and shelves

  void describe(navvi_config::Visitor& visit);
};

/// A layout by name: its difficulty in a word.
struct Preset {
  std::string name;
  std::string help;  ///< one line
  LayoutConfig config;
};

/// training, easy, warehouse, busy, narrow, maze: from the least difficult on.
[[nodiscard]] const std::vector<Preset>& presets();
/// nullopt for a word that is no preset.
[[nodiscard]] std::optional<LayoutConfig> preset(const std::string& name);

/// Two or more fields that cannot both be had, or one that asks for more than there is room for.
class LayoutError : public WorldError {
 public:
  /// \param key  the field that has to change
  LayoutError(std::string key, const std::string& sentence)
      : WorldError(sentence), key_(std::move(key)) {}
  [[nodiscard]] const std::string& key() const { return key_; }

 private:
  std::string key_;
};

}  // namespace navvi_sim::generate
