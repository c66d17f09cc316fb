#pragma once

#include <map>
#include <string>

namespace navvi_study::node {

/// From now on ends this node, and with it the roslaunch that started it, once the host of the ROS
/// master says twice, a second apart, that none listens there. Beside the thread that spins, as a
/// host may be slow to answer.
void end_with_master();

/// What a session stands on. roslaunch ends all nodes at once when a part of it ends, as it does at
/// Ctrl-C.
class SessionParts {
 public:
  /// Notes which processes bear the names of the parts.
  void note();

  /// The part that has ended by itself, as the reason of a trial's end: launcher_lost, where the
  /// roslaunch that started this node was killed; master_lost, where the ROS master does not
  /// answer; name_taken, where another process bears the name of a part than the one noted;
  /// simulator_lost, perception_lost or relay_lost, where that node is registered and nothing
  /// answers at its address, while one that ends in good order unregisters first; empty where none
  /// has.
  [[nodiscard]] std::string crashed() const;

 private:
  std::map<std::string, std::string> addresses_;  ///< by node; empty: not registered
};

}  // namespace navvi_study::node
