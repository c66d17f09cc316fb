#include "plugin/chosen.hpp"

#include <ros/ros.h>

namespace navvi_rviz::plugin {

Chosen& Chosen::shared() {
  static Chosen chosen;
  return chosen;
}

Chosen::Chosen() { choose(ros::param::param<std::string>("~vision", name_)); }

void Chosen::choose(const std::string& name) {
  if (name == name_ || !look::find_vision(name)) return;
  name_ = name;
  for (const auto& tell : listeners_) tell();
}

}  // namespace navvi_rviz::plugin
