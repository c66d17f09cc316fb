#include "smooth/turns.hpp"

#include <algorithm>

namespace navvi_nav::smooth {

std::vector<Turn> turns_of(const Path& path, double together) {
  std::vector<Turn> out;
  if (path.empty()) return out;
  Turn turn{1, 0.0};
  for (std::size_t i = 1; i + 1 < path.size(); ++i) {
    turn.angle += clockwise(path[i] - path[i - 1], path[i + 1] - path[i]);
    if (i + 2 < path.size() && distance(path[i], path[i + 1]) < together) continue;
    turn.angle = std::clamp(turn.angle, -kPi, kPi);
    if (std::abs(turn.angle) >= kBend || together <= 0.0) out.push_back(turn);
    turn = {i + 1, 0.0};
  }
  out.push_back({path.size() - 1, 0.0});
  return out;
}

}  // namespace navvi_nav::smooth
