#include "traffic/waiting_zones.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "traffic/lane_ground.hpp"

namespace navvi_sim::traffic {
namespace {

constexpr double kGap = 0.1;  // m, nearer lanes touch

class ZonePlanner {
 public:
  ZonePlanner(const WorldDescription& world, std::vector<Polygon> ground, Lanes& lanes)
      : world_(world), lanes_(lanes), ground_(std::move(ground)) {
    std::size_t offset = 0;
    for (const Lane& lane : lanes.lanes) {
      offsets_.push_back(offset);
      offset += static_cast<std::size_t>(lane.blocks);
    }
  }

  void plan() {
    forget_ground_behind();
    find_shared_ground();
    for (std::size_t lane = 0; lane < lanes_.lanes.size(); ++lane) choose_waiting_zones(lane);
    check_spacing();
    check_start();
  }

 private:
  /// A block of a lane.
  struct Block {
    std::size_t lane;
    int index;
  };

  /// A thing whose track ends never comes back to the ground behind its start.
  void forget_ground_behind() {
    for (std::size_t lane = 0; lane < lanes_.lanes.size(); ++lane) {
      const Lane& here = lanes_.lanes[lane];
      if (here.track.closed()) continue;
      const int start = here.block_at(lanes_.users[here.users[0]].start);
      for (int i = 0; i < start; ++i) ground_[number(lane, i)].clear();
    }
  }

  void find_shared_ground() {
    std::vector<std::size_t> lane_of(ground_.size());
    for (std::size_t i = 0; i < ground_.size(); ++i) lane_of[i] = block(i).lane;
    const auto wanted = [&](const PolygonIndex::Pair& pair) {
      return lane_of[pair.first] != lane_of[pair.second] ||
             is_shared(lanes_.lanes[lane_of[pair.first]]);
    };
    std::vector<std::map<int, std::set<int>>> own(lanes_.lanes.size());
    for (const auto& [a, b] : PolygonIndex(ground_, kGap).pairs(wanted)) {
      const Block first = block(a), second = block(b);
      if (first.lane == second.lane) {
        own[first.lane][first.index].insert(second.index);
        own[first.lane][second.index].insert(first.index);
      } else {
        lanes_.lanes[first.lane].shared_blocks.push_back(shared_block(first.index, second));
        lanes_.lanes[second.lane].shared_blocks.push_back(shared_block(second.index, first));
      }
    }
    for (std::size_t lane = 0; lane < lanes_.lanes.size(); ++lane) {
      Lane& here = lanes_.lanes[lane];
      if (is_shared(here)) {
        std::vector<std::set<int>> touched(static_cast<std::size_t>(here.blocks));
        for (auto& [index, others] : own[lane])
          touched[static_cast<std::size_t>(index)] = std::move(others);
        find_spacing(lane, std::move(touched));
      }
      std::sort(here.shared_blocks.begin(), here.shared_blocks.end(),
                [](const SharedBlock& a, const SharedBlock& b) {
                  return std::tie(a.block, a.lane, a.other) < std::tie(b.block, b.lane, b.other);
                });
      here.shared_blocks.shrink_to_fit();
      here.is_private.assign(static_cast<std::size_t>(here.blocks), true);
      for (const SharedBlock& shared_block : here.shared_blocks)
        here.is_private[static_cast<std::size_t>(shared_block.block)] = false;
    }
  }

  /// Bodies on one track touch where their blocks follow each other closely; `spacing` blocks apart
  /// they do not. Where the track comes back to its own ground from elsewhere, it crosses itself as
  /// if it were another lane.
  void find_spacing(std::size_t lane, std::vector<std::set<int>> touched) {
    Lane& here = lanes_.lanes[lane];
    const int count = here.blocks;
    here.spacing = 1;
    for (int i = 0; i < count; ++i) {
      const std::set<int>& others = touched[static_cast<std::size_t>(i)];
      std::set<int> near;
      for (const int step : {1, -1})
        for (int k = 1; k < count; ++k) {
          const int other = ((i + step * k) % count + count) % count;
          if (others.count(other) == 0) break;
          near.insert(other);
          here.spacing = std::max(here.spacing, k + 1);
        }
      for (const int other : others)
        if (near.count(other) == 0) here.shared_blocks.push_back(shared_block(i, {lane, other}));
    }
  }

  void choose_waiting_zones(std::size_t lane) {
    Lane& here = lanes_.lanes[lane];
    const std::string who = quoted(thing_of(here.users[0]));
    if (!here.track.closed() && !here.is_private.back())
      throw WorldError("thing " + who + " ends its route in the way of " + others_on(lane) +
                       "; allowed is an end where nothing else passes");
    const bool meets_nobody =
        !is_shared(here) && std::all_of(here.is_private.begin(), here.is_private.end(),
                                        [](bool alone) { return alone; });
    if (meets_nobody) return;

    const std::vector<int> zones = waiting_zones_of(lane);
    if (!is_shared(here) && zones.empty())
      throw WorldError("thing " + who +
                       " has no place on its route where it is out of the way of " +
                       others_on(lane) + "; each thing that moves needs one to wait in");
    if (is_shared(here) && zones.size() <= here.users.size()) {
      const std::string others = others_on(lane);
      throw WorldError("the track of " + who + " is shared by " +
                       std::to_string(here.users.size()) + " things and has " +
                       std::to_string(zones.size()) + " places to wait in" +
                       (others.empty() ? "" : " out of the way of " + others) +
                       "; allowed are fewer things than places");
    }
    for (std::size_t i = 0; i < zones.size(); ++i) {
      const int before = i > 0 ? zones[i - 1] : (here.track.closed() ? zones.back() : -1);
      const int begin = (before + 1) % here.blocks;
      here.segments.push_back({begin, zones[i], here.conflicts(begin, zones[i])});
    }
  }

  /// A lone user waits at the end of each private stretch. Users of a shared track need a chain of
  /// zones to move up in, `spacing` apart; stretches are filled from their ends.
  [[nodiscard]] std::vector<int> waiting_zones_of(std::size_t lane) const {
    const Lane& here = lanes_.lanes[lane];
    const int count = here.blocks;
    const auto is_private = [&](int i) {
      return static_cast<bool>(here.is_private[static_cast<std::size_t>((i + count) % count)]);
    };
    const auto ends_stretch = [&](int i) {
      return is_private(i) && (!is_private(i + 1) || (!here.track.closed() && i + 1 == count));
    };
    int last = count - 1;
    while (last > 0 && !ends_stretch(last)) --last;
    if (!ends_stretch(last)) last = count - 1;  // all is private
    std::vector<int> zones;
    int latest = 0;  // how far back the last one was found
    for (int back = 0; back < count; ++back) {
      const int i = (last - back + count) % count;
      if (!is_private(i) || ground_[number(lane, i)].empty()) continue;
      const bool has_room =
          zones.empty() || (back - latest >= here.spacing && count - back >= here.spacing);
      if (is_shared(here) ? !has_room : !ends_stretch(i)) continue;
      zones.push_back(i);
      latest = back;
    }
    std::sort(zones.begin(), zones.end());
    return zones;
  }

  /// Users of a shared track start with room to the one ahead, and on ground that other lanes touch
  /// with room to leave it.
  void check_spacing() const {
    for (const Lane& lane : lanes_.lanes) {
      if (!is_shared(lane)) continue;
      for (std::size_t i = 0; i < lane.users.size(); ++i) {
        const std::size_t user = lane.users[i], next = lane.users[(i + 1) % lane.users.size()];
        const int block = start_block(user);
        const int gap = (start_block(next) - block + lane.blocks) % lane.blocks;
        if (gap < lane.spacing)
          throw WorldError("things " + quoted(thing_of(user)) + " and " + quoted(thing_of(next)) +
                           " start too close to each other on the track they share; allowed are " +
                           std::to_string(lane.spacing * lane.block_length).substr(0, 4) +
                           " m or more");
        if (lane.is_private[static_cast<std::size_t>(block)]) continue;
        const int way = (first_segment(user).end - block + lane.blocks) % lane.blocks;
        if (gap < way + lane.spacing)
          throw WorldError("thing " + quoted(thing_of(user)) + " starts in the way of " +
                           others_on(lanes_.users[user].lane) + ", and " + quoted(thing_of(next)) +
                           " is too near ahead for it to leave; allowed are " +
                           std::to_string((way + lane.spacing) * lane.block_length).substr(0, 4) +
                           " m or more");
      }
    }
  }

  /// Users may start on shared ground if they can leave it one after another.
  void check_start() const {
    std::vector<std::size_t> waiting;
    for (std::size_t user = 0; user < lanes_.users.size(); ++user) {
      const Lane& lane = lanes_.lanes[lanes_.users[user].lane];
      if (!lane.is_private[static_cast<std::size_t>(start_block(user))]) waiting.push_back(user);
    }
    for (bool any = true; any;) {
      any = false;
      for (auto user = waiting.begin(); user != waiting.end();) {
        const bool free = std::none_of(waiting.begin(), waiting.end(), [&](std::size_t other) {
          return other != *user && starts_in_way(*user, other);
        });
        any = any || free;
        user = free ? waiting.erase(user) : user + 1;
      }
    }
    if (waiting.empty()) return;
    std::string names;
    for (std::size_t i = 0; i < std::min<std::size_t>(waiting.size(), 4); ++i)
      names += (i > 0 ? ", " : "") + quoted(thing_of(waiting[i]));
    throw WorldError(
        "things " + names + (waiting.size() > 4 ? " and others" : "") +
        " start in each other's way; allowed are places that one of them can leave first");
  }

  /// The segment that a user on shared ground starts on.
  [[nodiscard]] const Segment& first_segment(std::size_t user) const {
    const std::vector<Segment>& segments = lanes_.lanes[lanes_.users[user].lane].segments;
    const auto found = std::find_if(segments.begin(), segments.end(), [&](const Segment& segment) {
      return segment.end >= start_block(user);
    });
    return found == segments.end() ? segments.front() : *found;
  }

  /// True if the first segment of one touches the ground that the other starts on.
  [[nodiscard]] bool starts_in_way(std::size_t user, std::size_t other) const {
    const int taken = start_block(other);
    const Segment& first = first_segment(user);
    return std::any_of(first.conflicts.begin(), first.conflicts.end(),
                       [&](const Conflict& conflict) {
                         return conflict.lane == lanes_.users[other].lane &&
                                conflict.first <= taken && taken <= conflict.last;
                       });
  }

  [[nodiscard]] int start_block(std::size_t user) const {
    return lanes_.lanes[lanes_.users[user].lane].block_at(lanes_.users[user].start);
  }
  [[nodiscard]] static SharedBlock shared_block(int block, const Block& other) {
    return {block, static_cast<std::uint32_t>(other.lane), other.index};
  }
  [[nodiscard]] bool is_shared(const Lane& lane) const { return lane.users.size() > 1; }
  [[nodiscard]] std::size_t number(std::size_t lane, int index) const {
    return offsets_[lane] + static_cast<std::size_t>(index);
  }
  [[nodiscard]] Block block(std::size_t number) const {
    const auto lane = static_cast<std::size_t>(
        std::upper_bound(offsets_.begin(), offsets_.end(), number) - offsets_.begin() - 1);
    return {lane, static_cast<int>(number - offsets_[lane])};
  }
  [[nodiscard]] const Thing& thing_of(std::size_t user) const {
    return world_.things[lanes_.users[user].thing];
  }

  [[nodiscard]] std::string others_on(std::size_t lane) const {
    std::map<std::size_t, std::size_t> shared;  // blocks, by lane
    for (const SharedBlock& shared_block : lanes_.lanes[lane].shared_blocks)
      if (shared_block.lane != lane) ++shared[shared_block.lane];
    std::vector<std::pair<std::size_t, std::size_t>> order;
    for (const auto& [other, count] : shared) order.emplace_back(count, other);
    std::sort(order.rbegin(), order.rend());
    std::string names;
    for (std::size_t i = 0; i < std::min<std::size_t>(order.size(), 3); ++i)
      names += (i > 0 ? ", " : "") + quoted(thing_of(lanes_.lanes[order[i].second].users[0]));
    if (order.size() > 3) names += " and " + std::to_string(order.size() - 3) + " others";
    return names;
  }

  const WorldDescription& world_;
  Lanes& lanes_;
  std::vector<Polygon> ground_;
  std::vector<std::size_t> offsets_;  ///< of each lane's blocks in ground_
};

}  // namespace

void find_waiting_zones(const WorldDescription& world, std::vector<Polygon> ground, Lanes& lanes) {
  ZonePlanner(world, std::move(ground), lanes).plan();
}

}  // namespace navvi_sim::traffic
