#include "generate/layout.hpp"

#include <algorithm>
#include <iterator>

#include "generate/floor_plan.hpp"
#include "generate/layout_goods.hpp"
#include "generate/layout_hall.hpp"
#include "generate/layout_traffic.hpp"

namespace navvi_sim::generate {
namespace {

/// One use of the seed: to change one of them leaves what the others draw as it is.
enum class Stream : std::uint64_t { plan = 1, stock, traffic, staging, clutter };

Random stream(std::uint64_t seed, Stream use) {
  return Random(Random(seed + (static_cast<std::uint64_t>(use) << 56U)).next());
}

}  // namespace

WorldDescription layout(const std::string& name, const LayoutConfig& config, std::uint64_t seed) {
  Random random = stream(seed, Stream::plan);
  const FloorPlan plan(config, random);
  LayoutGoods goods(plan, config);
  // Laid before anything is left in an aisle, which then is one where nothing moves.
  LayoutTraffic traffic(plan, config, stream(seed, Stream::traffic));
  std::vector<Thing> movers = traffic.movers();

  WorldDescription world;
  world.name = name;
  world.places = plan.places();
  const auto add = [&](std::vector<Thing> things) {
    std::move(things.begin(), things.end(), std::back_inserter(world.things));
  };
  add(LayoutHall(plan, random).things());
  add(goods.racks(stream(seed, Stream::stock)));
  add(goods.staged(stream(seed, Stream::staging)));
  add(goods.left_behind(stream(seed, Stream::clutter), traffic));
  add(std::move(movers));
  return world;
}

}  // namespace navvi_sim::generate
