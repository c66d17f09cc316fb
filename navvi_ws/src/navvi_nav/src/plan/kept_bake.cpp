#include "plan/kept_bake.hpp"

#include <cstdint>
#include <navvi_config/writer.hpp>
#include <navvi_files/bytes.hpp>
#include <utility>
#include <vector>

namespace navvi_nav::plan {
namespace {

std::string key_of(const NavMesh& mesh, const map::Voxels& map, std::optional<double> stands_at) {
  navvi_files::ByteWriter voxels, key;
  voxels.put(map.error, map.octets, map.boxes);
  key.put(std::string_view("mesh"), navvi_config::write(mesh.config()), mesh.clearance(),
          stands_at.has_value(), stands_at.value_or(0.0), map.resolution,
          navvi_files::hash_of(voxels.bytes()), voxels.bytes().size());
  return key.bytes();
}

/// Equal cells of the ground, one behind the other.
struct Run {
  std::uint32_t ground;
  std::uint32_t cells;
};

std::vector<Run> runs_of(const map::Floor& floor) {
  std::vector<Run> out;
  for (int y = 0; y < floor.rows(); ++y) {
    const map::Ground* row = floor.all_ground().row(y);
    for (int x = 0; x < floor.columns(); ++x) {
      const auto ground = static_cast<std::uint32_t>(row[x]);
      if (out.empty() || out.back().ground != ground) out.push_back({ground, 0});
      ++out.back().cells;
    }
  }
  return out;
}

/// Its floor and its tiles, but not what the next map is compared with, which is then surveyed and
/// baked as a whole. Distances are measured again, which costs less than to read them.
std::string to_bytes(const bake::BakedMap& baked) {
  const map::Floor& floor = *baked.floor;
  navvi_files::ByteWriter out;
  out.put(floor.origin().x, floor.origin().y, floor.columns(), floor.rows(), floor.cell_size(),
          floor.height(), floor.reach(), floor.margin(), runs_of(floor));
  out.put(baked.tile_cells, baked.tiles.size());
  for (const auto& [tile, polygons] : baked.tiles) {
    out.put(tile.first, tile.second, polygons.size());
    for (const mesh::GridPolygon& polygon : polygons) out.put(polygon.corners);
  }
  return out.bytes();
}

/// All tiles are rebuilt ones, as of a first map.
bake::BakedMap from_bytes(std::string_view bytes, int threads) {
  navvi_files::ByteReader in(bytes);
  int columns = 0, rows = 0;
  std::vector<Run> runs;
  map::FloorGround ground;
  map::FloorDistances distances;
  in.get(ground.origin.x, ground.origin.y, columns, rows, ground.cell_size, ground.height,
         distances.reach, distances.margin, runs);
  std::vector<map::Ground> cells;
  for (const Run& run : runs)
    cells.insert(cells.end(), run.cells, static_cast<map::Ground>(run.ground));
  ground.ground = {columns, rows, cells.data()};

  bake::BakedMap out;
  out.floor = std::make_shared<const map::Floor>(std::move(ground), distances, threads);
  std::size_t tiles = 0, polygons = 0;
  in.get(out.tile_cells, tiles);
  for (; tiles > 0; --tiles) {
    bake::TileIndex tile;
    in.get(tile.first, tile.second, polygons);
    out.tiles[tile].resize(polygons);
    for (mesh::GridPolygon& polygon : out.tiles[tile]) in.get(polygon.corners);
    out.rebuilt.push_back(tile);
  }
  return out;
}

}  // namespace

bake::BakedMap kept_bake(const NavMesh& mesh, const map::Voxels& map,
                         std::optional<double> stands_at, const navvi_files::Cache& cache) {
  const std::string key = key_of(mesh, map, stands_at);
  if (const auto bytes = cache.find(key))
    return from_bytes(*bytes, mesh.config().threads);
  bake::BakedMap baked = mesh.bake(map, stands_at);
  if (baked.error.empty()) cache.keep(key, to_bytes(baked));
  return baked;
}

}  // namespace navvi_nav::plan
