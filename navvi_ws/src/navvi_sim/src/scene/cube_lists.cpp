#include "scene/cube_lists.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace navvi_sim::scene {

constexpr std::size_t kVeryMany = 20000;  // cubes
constexpr std::size_t kLongList = 2000;   // cubes
constexpr double kTile = 50.0;            // m

using visualization_msgs::Marker;

void CubeLists::add(const std::string& ns, const Color& color, const Eigen::AlignedBox3d& cube) {
  const Eigen::Vector3d size = cube.sizes();
  const auto thousandths = [](double value) { return std::lround(1000.0 * value); };
  const Key key{ns,
                {thousandths(color.r), thousandths(color.g), thousandths(color.b),
                 thousandths(size.x()), thousandths(size.y()), thousandths(size.z())}};
  List& list = lists_.try_emplace(key, List{ns, color, size, {}}).first->second;
  list.centres.push_back(cube.center());
}

std::vector<CubeLists::List> CubeLists::tiled() const {
  std::size_t cubes = 0;
  for (const auto& entry : lists_) cubes += entry.second.centres.size();
  std::vector<List> lists;
  for (const auto& entry : lists_) {
    const List& list = entry.second;
    std::map<std::pair<long, long>, List> tiles;
    const bool cut = cubes > kVeryMany && list.centres.size() > kLongList;
    for (const Eigen::Vector3d& centre : list.centres) {
      const std::pair<long, long> tile{std::lround(centre.x() / kTile),
                                       std::lround(centre.y() / kTile)};
      List& part = tiles
                       .try_emplace(cut ? tile : std::pair<long, long>{},
                                    List{list.ns, list.color, list.size, {}})
                       .first->second;
      part.centres.push_back(centre);
    }
    for (auto& part : tiles) lists.push_back(std::move(part.second));
  }
  return lists;
}

std::vector<Marker> CubeLists::markers(std::size_t most,
                                       std::map<std::string, int>& next_id) const {
  std::vector<List> ordered = tiled();
  std::stable_sort(ordered.begin(), ordered.end(), [](const List& a, const List& b) {
    return a.centres.size() > b.centres.size();
  });
  std::vector<Marker> markers;
  std::map<std::string, Marker> rest;
  for (std::size_t i = 0; i < ordered.size(); ++i) {
    const List& list = ordered[i];
    if (i < most) {
      Marker msg =
          marker_msg(list.ns, next_id[list.ns]++, Marker::CUBE_LIST, list.color, list.size);
      for (const Eigen::Vector3d& centre : list.centres) msg.points.push_back(point_msg(centre));
      markers.push_back(std::move(msg));
      continue;
    }
    if (rest.count(list.ns) == 0)
      rest[list.ns] = marker_msg(list.ns, next_id[list.ns]++, Marker::TRIANGLE_LIST, list.color);
    Painter painter(rest[list.ns], list.color, std::numeric_limits<double>::max());
    for (const Eigen::Vector3d& centre : list.centres)
      painter.shape(Box{list.size}, Eigen::Isometry3d(Eigen::Translation3d(centre)));
  }
  for (auto& entry : rest) markers.push_back(std::move(entry.second));
  return markers;
}

}  // namespace navvi_sim::scene
