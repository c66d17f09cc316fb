#include "bake/baked_bytes.hpp"

#include <algorithm>
#include <cstdint>
#include <navvi_files/bytes.hpp>
#include <utility>
#include <vector>

namespace navvi_nav::bake {
namespace {

using navvi_files::ByteReader;
using navvi_files::ByteWriter;

/// The ground as runs of equal cells; distances are measured again, which costs less than to read
/// them.
void put(ByteWriter& out, const map::Floor& floor) {
  for (const int number : {floor.origin().x, floor.origin().y, floor.columns(), floor.rows()})
    out.put(number);
  for (const double number : {floor.cell_size(), floor.height(), floor.reach(), floor.margin()})
    out.put(number);
  std::vector<std::uint32_t> lengths;
  std::vector<std::uint8_t> kinds;
  for (int y = 0; y < floor.rows(); ++y) {
    const map::Ground* row = floor.all_ground().row(y);
    for (int x = 0; x < floor.columns(); ++x) {
      const auto kind = static_cast<std::uint8_t>(row[x]);
      if (kinds.empty() || kinds.back() != kind) {
        kinds.push_back(kind);
        lengths.push_back(0);
      }
      ++lengths.back();
    }
  }
  out.put(lengths);
  out.put(kinds);
}

/// \returns nullptr if there is none
std::shared_ptr<const map::Floor> get_floor(ByteReader& in, int threads) {
  map::FloorGround ground;
  ground.origin.x = in.get<int>();
  ground.origin.y = in.get<int>();
  const int columns = in.get<int>();
  const int rows = in.get<int>();
  ground.cell_size = in.get<double>();
  ground.height = in.get<double>();
  map::FloorDistances distances;
  distances.reach = in.get<double>();
  distances.margin = in.get<double>();
  const auto lengths = in.get_all<std::uint32_t>();
  const auto kinds = in.get_all<std::uint8_t>();
  std::size_t left = static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  std::vector<map::Ground> cells;
  cells.reserve(left);
  for (std::size_t i = 0; i < std::min(lengths.size(), kinds.size()); ++i) {
    if (lengths[i] > left) return nullptr;
    cells.insert(cells.end(), lengths[i], static_cast<map::Ground>(kinds[i]));
    left -= lengths[i];
  }
  if (left > 0 || !in.good()) return nullptr;
  ground.ground = {columns, rows, cells.data()};
  return std::make_shared<const map::Floor>(std::move(ground), distances, threads);
}

void put(ByteWriter& out, const std::vector<mesh::GridPolygon>& polygons) {
  std::vector<std::uint32_t> counts;
  std::vector<int> places;
  for (const mesh::GridPolygon& polygon : polygons) {
    counts.push_back(static_cast<std::uint32_t>(polygon.corners.size()));
    for (const auto& corner : polygon.corners)
      places.insert(places.end(), corner.begin(), corner.end());
  }
  out.put(counts);
  out.put(places);
}

std::vector<mesh::GridPolygon> get_polygons(ByteReader& in) {
  const auto counts = in.get_all<std::uint32_t>();
  const auto places = in.get_all<int>();
  std::vector<mesh::GridPolygon> out;
  auto next = places.begin();
  for (const std::uint32_t count : counts) {
    mesh::GridPolygon& polygon = out.emplace_back();
    for (std::uint32_t k = 0; k < count && places.end() - next >= 2; ++k, next += 2)
      polygon.corners.push_back({next[0], next[1]});
  }
  return out;
}

}  // namespace

std::string to_bytes(const BakedMap& baked) {
  ByteWriter out;
  put(out, *baked.floor);
  out.put(baked.tile_cells);
  out.put(std::uint64_t{baked.tiles.size()});
  for (const auto& [tile, polygons] : baked.tiles) {
    out.put(tile.first);
    out.put(tile.second);
    put(out, polygons);
  }
  return out.bytes();
}

std::optional<BakedMap> from_bytes(std::string_view bytes, int threads) {
  ByteReader in(bytes);
  BakedMap out;
  out.floor = get_floor(in, threads);
  if (!out.floor) return std::nullopt;
  out.tile_cells = in.get<int>();
  for (auto left = in.get<std::uint64_t>(); left > 0 && in.good(); --left) {
    const int column = in.get<int>();
    const TileIndex tile{column, in.get<int>()};
    out.tiles[tile] = get_polygons(in);
    out.rebuilt.push_back(tile);
  }
  return in.ends_well() ? std::optional(std::move(out)) : std::nullopt;
}

}  // namespace navvi_nav::bake
