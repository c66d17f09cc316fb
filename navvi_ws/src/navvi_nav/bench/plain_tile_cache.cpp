#include "plain_tile_cache.hpp"

#include <DetourCommon.h>
#include <DetourNavMeshBuilder.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace navvi_nav::plain {
namespace {

constexpr int kLayers = 4;  // of a tile
constexpr int kMaxObstacles = 4096;
constexpr float kMaxError = 1.3F;                     // cells
constexpr std::size_t kArena = std::size_t{4} << 20;  // bytes

using Layers = std::unique_ptr<rcHeightfieldLayerSet,
                               Release<rcHeightfieldLayerSet, rcFreeHeightfieldLayerSet>>;

}  // namespace

/// Hands out one block bit by bit; a tile's building takes it from the start again.
struct TileCache::Arena : dtTileCacheAlloc {
  std::vector<unsigned char> block = std::vector<unsigned char>(kArena);
  std::size_t used = 0;
  void reset() override { used = 0; }
  void* alloc(std::size_t size) override {
    if (used + size > block.size()) return nullptr;
    void* at = block.data() + used;
    used += (size + 15) / 16 * 16;
    return at;
  }
  void free(void*) override {}
};

struct TileCache::Copy : dtTileCacheCompressor {
  int maxCompressedSize(int size) override { return size; }
  dtStatus compress(const unsigned char* from, int size, unsigned char* to, int,
                    int* written) override {
    std::memcpy(to, from, static_cast<std::size_t>(size));
    *written = size;
    return DT_SUCCESS;
  }
  dtStatus decompress(const unsigned char* from, int size, unsigned char* to, int,
                      int* written) override {
    std::memcpy(to, from, static_cast<std::size_t>(size));
    *written = size;
    return DT_SUCCESS;
  }
};

struct TileCache::Flags : dtTileCacheMeshProcess {
  void process(dtNavMeshCreateParams* params, unsigned char*, unsigned short* flags) override {
    std::fill_n(flags, params->polyCount, kWalk);
  }
};

TileCache::TileCache(const Columns& columns, double robot_radius, double robot_height, int tile)
    : arena_(std::make_unique<Arena>()),
      copy_(std::make_unique<Copy>()),
      flags_(std::make_unique<Flags>()),
      cache_(dtAllocTileCache()),
      mesh_(dtAllocNavMesh()),
      robot_radius_(robot_radius),
      robot_height_(robot_height) {
  const int across = (columns.width() + tile - 1) / tile;
  const int along = (columns.height() + tile - 1) / tile;
  const std::array<float, 3> low = columns.low();
  dtTileCacheParams params{};
  std::copy(low.begin(), low.end(), params.orig);
  params.cs = params.ch = static_cast<float>(columns.cell());
  params.width = params.height = tile;
  params.walkableHeight = static_cast<float>(robot_height);
  params.walkableRadius = static_cast<float>(robot_radius);
  params.maxSimplificationError = kMaxError;
  params.maxTiles = across * along * kLayers;
  params.maxObstacles = kMaxObstacles;
  require(dtStatusSucceed(cache_->init(&params, arena_.get(), copy_.get(), flags_.get())),
          "dtTileCache::init");
  dtNavMeshParams mesh{};
  std::copy(low.begin(), low.end(), mesh.orig);
  mesh.tileWidth = mesh.tileHeight = static_cast<float>(tile * columns.cell());
  const int bits =
      std::min(14, static_cast<int>(dtIlog2(dtNextPow2(static_cast<unsigned>(params.maxTiles)))));
  mesh.maxTiles = 1 << bits;
  mesh.maxPolys = 1 << (22 - bits);
  require(dtStatusSucceed(mesh_->init(&mesh)), "dtNavMesh::init");
  for (int ty = 0; ty < along; ++ty)
    for (int tx = 0; tx < across; ++tx) add_tile(columns, tx, ty, tile, robot_radius, robot_height);
  for (int ty = 0; ty < along; ++ty)
    for (int tx = 0; tx < across; ++tx) cache_->buildNavMeshTilesAt(tx, ty, mesh_.get());
}

TileCache::~TileCache() = default;

void TileCache::add_tile(const Columns& columns, int tx, int ty, int tile, double robot_radius,
                         double robot_height) {
  rcContext context(false);
  const double cell = columns.cell();
  const int border = static_cast<int>(std::ceil(robot_radius / cell)) + 3;
  const int side = tile + 2 * border;
  const CompactField field =
      walkable(context, columns.window(context, tx * tile - border, ty * tile - border, side, side),
               robot_radius, robot_height);
  const Layers layers(rcAllocHeightfieldLayerSet());
  require(
      layers && rcBuildHeightfieldLayers(&context, *field, border,
                                         static_cast<int>(std::ceil(robot_height / cell)), *layers),
      "rcBuildHeightfieldLayers");
  for (int i = 0; i < std::min(layers->nlayers, kLayers); ++i) {
    const rcHeightfieldLayer& layer = layers->layers[i];
    dtTileCacheLayerHeader header{};
    header.magic = DT_TILECACHE_MAGIC;
    header.version = DT_TILECACHE_VERSION;
    header.tx = tx;
    header.ty = ty;
    header.tlayer = i;
    dtVcopy(header.bmin, layer.bmin);
    dtVcopy(header.bmax, layer.bmax);
    header.width = static_cast<unsigned char>(layer.width);
    header.height = static_cast<unsigned char>(layer.height);
    header.minx = static_cast<unsigned char>(layer.minx);
    header.maxx = static_cast<unsigned char>(layer.maxx);
    header.miny = static_cast<unsigned char>(layer.miny);
    header.maxy = static_cast<unsigned char>(layer.maxy);
    header.hmin = static_cast<unsigned short>(layer.hmin);
    header.hmax = static_cast<unsigned short>(layer.hmax);
    unsigned char* data = nullptr;
    int size = 0;
    require(dtStatusSucceed(dtBuildTileCacheLayer(copy_.get(), &header, layer.heights, layer.areas,
                                                  layer.cons, &data, &size)),
            "dtBuildTileCacheLayer");
    require(dtStatusSucceed(cache_->addTile(data, size, DT_COMPRESSEDTILE_FREE_DATA, nullptr)),
            "dtTileCache::addTile");
  }
}

void TileCache::catch_up() {
  for (bool done = false; !done;) {
    require(dtStatusSucceed(cache_->update(0.0F, mesh_.get(), &done)), "dtTileCache::update");
  }
}

void TileCache::place(const std::vector<Cylinder>& cylinders) {
  // The queue of requests is short: what does not fit waits until it has been worked off.
  for (const dtObstacleRef obstacle : placed_) {
    while (dtStatusDetail(cache_->removeObstacle(obstacle), DT_BUFFER_TOO_SMALL)) catch_up();
  }
  placed_.clear();
  for (const Cylinder& cylinder : cylinders) {
    const float at[3] = {static_cast<float>(cylinder.center.x), 0.0F,
                         static_cast<float>(cylinder.center.y)};
    const auto radius = static_cast<float>(cylinder.radius + robot_radius_);
    dtObstacleRef obstacle = 0;
    while (dtStatusDetail(
        cache_->addObstacle(at, radius, static_cast<float>(robot_height_), &obstacle),
        DT_BUFFER_TOO_SMALL))
      catch_up();
    placed_.push_back(obstacle);
  }
  catch_up();
}

}  // namespace navvi_nav::plain
