#include "plain_tile_cache.hpp"

#include <DetourCommon.h>
#include <DetourNavMeshBuilder.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace navvi_nav::plain {

constexpr int kMaxNodes = 65535;                // the most that Detour can count
constexpr int kMaxPolygons = 16384;             // of one path
constexpr double kRounding = 1e-6;              // of a cell
constexpr float kFloor = 0.0F;                  // m, Recast's y
constexpr float kNear[3] = {0.5F, 0.3F, 0.5F};  // m, findNearestPoly's half extents

constexpr int kLayers = 4;  // of a tile
constexpr int kMaxObstacles = 4096;
constexpr float kMaxError = 1.3F;                     // cells
constexpr std::size_t kArena = std::size_t{4} << 20;  // bytes

using Layers = std::unique_ptr<rcHeightfieldLayerSet,
                               Release<rcHeightfieldLayerSet, rcFreeHeightfieldLayerSet>>;

void require(bool done, const char* step) {
  if (!done) throw std::runtime_error(std::string("the plain bake failed in ") + step);
}

Columns::Columns(const octomap::OcTree& tree) : cell_(tree.getResolution()) {
  std::array<double, 3> high{};
  tree.getMetricMin(low_[0], low_[1], low_[2]);
  tree.getMetricMax(high[0], high[1], high[2]);
  const auto cells = [this](double length) {
    return static_cast<int>(std::lround(length / cell_));
  };
  width_ = cells(high[0] - low_[0]);
  height_ = cells(high[1] - low_[1]);
  levels_ = cells(high[2] - low_[2]);
  rcContext context(false);
  all_ = field(context, 0, 0, width_, height_);
  for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf) {
    if (!tree.isNodeOccupied(*leaf)) continue;
    const double half = leaf.getSize() / 2.0;
    const int x = cells(leaf.getX() - half - low_[0]), y = cells(leaf.getY() - half - low_[1]);
    const int bottom = cells(leaf.getZ() - half - low_[2]), side = cells(leaf.getSize());
    for (int row = y; row < y + side; ++row)
      for (int column = x; column < x + side; ++column)
        rcAddSpan(&context, *all_, column, row, static_cast<unsigned short>(bottom),
                  static_cast<unsigned short>(bottom + side), RC_WALKABLE_AREA, 0);
  }
}

std::array<float, 3> Columns::low() const {
  return {static_cast<float>(low_[0]), static_cast<float>(low_[2]), static_cast<float>(low_[1])};
}

HeightField Columns::field(rcContext& context, int x, int y, int columns, int rows) const {
  const float low[3] = {static_cast<float>(low_[0] + x * cell_), static_cast<float>(low_[2]),
                        static_cast<float>(low_[1] + y * cell_)};
  const float high[3] = {static_cast<float>(low_[0] + (x + columns) * cell_),
                         static_cast<float>(low_[2] + levels_ * cell_),
                         static_cast<float>(low_[1] + (y + rows) * cell_)};
  HeightField field(rcAllocHeightfield());
  require(field && rcCreateHeightfield(&context, *field, columns, rows, low, high,
                                       static_cast<float>(cell_), static_cast<float>(cell_)),
          "rcCreateHeightfield");
  return field;
}

HeightField Columns::window(rcContext& context, int x, int y, int columns, int rows) const {
  HeightField window = field(context, x, y, columns, rows);
  for (int row = std::max(0, y); row < std::min(height_, y + rows); ++row)
    for (int column = std::max(0, x); column < std::min(width_, x + columns); ++column)
      for (const rcSpan* span = all_->spans[row * width_ + column]; span; span = span->next)
        rcAddSpan(&context, *window, column - x, row - y, static_cast<unsigned short>(span->smin),
                  static_cast<unsigned short>(span->smax), RC_WALKABLE_AREA, 0);
  return window;
}

CompactField walkable(rcContext& context, HeightField heights, double robot_radius,
                      double robot_height) {
  const double cell = static_cast<double>(heights->cs);
  const auto whole = [cell](double length) {
    return static_cast<int>(std::ceil(length / cell - kRounding));
  };
  rcFilterWalkableLowHeightSpans(&context, whole(robot_height), *heights);
  CompactField field(rcAllocCompactHeightfield());
  require(field && rcBuildCompactHeightfield(&context, whole(robot_height), 0, *heights, *field),
          "rcBuildCompactHeightfield");
  heights.reset();
  require(rcErodeWalkableArea(&context, whole(robot_radius), *field), "rcErodeWalkableArea");
  return field;
}

Query::Query(const dtNavMesh& mesh)
    : query_(dtAllocNavMeshQuery()), corridor_(kMaxPolygons), corners_(3 * kMaxPolygons) {
  require(dtStatusSucceed(query_->init(&mesh, kMaxNodes)), "dtNavMeshQuery::init");
}

bool Query::locate(Point start, Point goal) {
  const std::array<Point, 2> wanted{start, goal};
  for (std::size_t i = 0; i < 2; ++i) {
    const float center[3] = {static_cast<float>(wanted[i].x), kFloor,
                             static_cast<float>(wanted[i].y)};
    query_->findNearestPoly(center, kNear, &filter_, &ends_[i], points_[i].data());
  }
  return ends_[0] != 0 && ends_[1] != 0;
}

Path Query::search() {
  const float* from = points_[0].data();
  const float* to = points_[1].data();
  int polygons = 0;
  const dtStatus found = query_->findPath(ends_[0], ends_[1], from, to, &filter_, corridor_.data(),
                                          &polygons, kMaxPolygons);
  if (dtStatusFailed(found) || dtStatusDetail(found, DT_PARTIAL_RESULT)) return {};
  int count = 0;
  const dtStatus drawn =
      query_->findStraightPath(from, to, corridor_.data(), polygons, corners_.data(), nullptr,
                               nullptr, &count, kMaxPolygons);
  if (dtStatusFailed(drawn)) return {};
  Path path;
  path.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    const float* corner = &corners_[static_cast<std::size_t>(3 * i)];
    path.push_back({static_cast<double>(corner[0]), static_cast<double>(corner[2])});
  }
  return path;
}

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
  dtStatus decompress(const unsigned char* from, int size, unsigned char* to, int most,
                      int* written) override {
    return compress(from, size, to, most, written);
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
