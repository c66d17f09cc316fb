#include "plan/kept_bake.hpp"

#include <navvi_config/writer.hpp>
#include <navvi_files/bytes.hpp>
#include <utility>

#include "bake/baked_bytes.hpp"

namespace navvi_nav::plan {
namespace {

std::string key_of(const NavMesh& mesh, const map::MapBytes& map, std::optional<double> stands_at) {
  navvi_files::ByteWriter key;
  key.put(std::string_view("mesh"));
  key.put(std::string_view(navvi_config::write(mesh.config())));
  key.put(mesh.clearance());
  key.put(stands_at.has_value());
  key.put(stands_at.value_or(0.0));
  key.put(std::string_view(map.id));
  key.put(map.binary);
  key.put(map.resolution);
  const std::string_view data(reinterpret_cast<const char*>(map.data), map.size);
  key.put(navvi_files::hash_of(data));
  key.put(std::uint64_t{map.size});
  return key.bytes();
}

}  // namespace

bake::BakedMap kept_bake(const NavMesh& mesh, const map::MapBytes& map,
                         std::optional<double> stands_at, const navvi_files::Cache& cache) {
  const std::string key = key_of(mesh, map, stands_at);
  if (const auto bytes = cache.find(key))
    if (auto kept = bake::from_bytes(*bytes, mesh.config().threads)) return *std::move(kept);
  bake::BakedMap baked = mesh.bake(map, stands_at);
  if (baked.error.empty()) cache.keep(key, bake::to_bytes(baked));
  return baked;
}

}  // namespace navvi_nav::plan
