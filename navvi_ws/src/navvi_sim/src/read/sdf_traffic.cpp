#include "read/sdf_traffic.hpp"

#include <algorithm>
#include <set>

#include "traffic/lanes.hpp"

namespace navvi_sim::read {
namespace {

constexpr int kMaxRounds = 4;

/// Finds which of the things with a route can keep it.
class RouteFilter {
 public:
  RouteFilter(const WorldDescription& world, const std::vector<std::string>& places,
              SdfNotes& notes)
      : world_(world), places_(places), notes_(notes) {
    for (std::size_t i = 0; i < world.things.size(); ++i)
      if (world.things[i].route) movers_.push_back(i);
  }

  /// The things that must stand.
  [[nodiscard]] std::set<std::size_t> things_without_route() {
    // A thing without its route then stands in the way of others.
    for (int round = 0; round < kMaxRounds; ++round) {
      driving_.clear();
      std::vector<std::size_t> hopeful;
      for (const std::size_t mover : movers_)
        if (standing_.count(mover) == 0) hopeful.push_back(mover);
      try_all(hopeful);
      if (objection({}).empty()) return standing_;
    }
    for (const std::size_t mover : movers_) give_up(mover, "too many others are in its way");
    return standing_;
  }

 private:
  /// Why the driving things and `more` cannot drive together; empty if they can.
  [[nodiscard]] std::string objection(const std::vector<std::size_t>& more) const {
    WorldDescription world;
    world.name = world_.name;
    world.floor_height = world_.floor_height;
    for (std::size_t i = 0; i < world_.things.size(); ++i) {
      const Thing& thing = world_.things[i];
      const bool drives =
          driving_.count(i) > 0 || std::find(more.begin(), more.end(), i) != more.end();
      const bool stands = !thing.route || standing_.count(i) > 0;
      if (!drives && !stands) continue;
      world.things.push_back(thing);
      if (!drives) world.things.back().route.reset();
    }
    try {
      static_cast<void>(traffic::lay_lanes(world, {}));
    } catch (const WorldError& error) {
      return error.what();
    }
    return "";
  }

  void try_all(const std::vector<std::size_t>& batch) {
    if (batch.empty()) return;
    const std::string why = objection(batch);
    if (why.empty()) {
      driving_.insert(batch.begin(), batch.end());
    } else if (batch.size() == 1) {
      give_up(batch[0], why);
    } else {
      const auto half = batch.begin() + static_cast<std::ptrdiff_t>(batch.size() / 2);
      try_all({batch.begin(), half});
      try_all({half, batch.end()});
    }
  }

  void give_up(std::size_t mover, const std::string& why) {
    if (standing_.insert(mover).second)
      notes_.add(places_[mover],
                 "'" + world_.things[mover].name +
                     "' stands where its way begins, since it cannot drive it: " + why);
  }

  const WorldDescription& world_;
  const std::vector<std::string>& places_;
  SdfNotes& notes_;
  std::vector<std::size_t> movers_;
  std::set<std::size_t> driving_;
  std::set<std::size_t> standing_;
};

}  // namespace

void keep_routes_that_can_be_driven(WorldDescription& world, const std::vector<std::string>& places,
                                    SdfNotes& notes) {
  for (const std::size_t thing : RouteFilter(world, places, notes).things_without_route())
    world.things[thing].route.reset();
}

}  // namespace navvi_sim::read
