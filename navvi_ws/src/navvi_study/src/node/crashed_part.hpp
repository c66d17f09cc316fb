#pragma once

#include <string>

namespace navvi_study::node {

/// The part of the session that has crashed, as the reason of a trial's end: launcher_lost, where
/// the roslaunch that started this node was killed; master_lost, where the ROS master does not
/// answer; simulator_lost, perception_lost or relay_lost, where that node is registered and nothing
/// answers at its address, while one that ends in good order unregisters first; empty where none
/// has crashed. roslaunch ends all nodes at once when one of these ends, as it does at Ctrl-C.
[[nodiscard]] std::string crashed_part();

}  // namespace navvi_study::node
