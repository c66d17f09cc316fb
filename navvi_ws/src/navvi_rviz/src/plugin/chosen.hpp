#pragma once

#include <ros/ros.h>

#include <functional>
#include <string>
#include <vector>

#include "look/vision.hpp"

namespace navvi_rviz::plugin {

/// What a person chose, for all displays and the panel in this process: the vision, first from the
/// parameter ~vision. Only the GUI's thread may use it.
class Chosen {
 public:
  static Chosen& shared() {
    static Chosen chosen;
    return chosen;
  }

  [[nodiscard]] const look::Vision& vision() const { return *look::find_vision(name_); }
  [[nodiscard]] const std::string& name() const { return name_; }
  /// An unknown name changes nothing.
  void choose(const std::string& name) {
    if (name == name_ || !look::find_vision(name)) return;
    name_ = name;
    for (const auto& tell : listeners_) tell();
  }
  /// Calls `tell` after each change, as long as this process lives.
  void on_change(std::function<void()> tell) { listeners_.push_back(std::move(tell)); }

 private:
  Chosen() { choose(ros::param::param<std::string>("~vision", name_)); }

  std::string name_ = "high_contrast";
  std::vector<std::function<void()>> listeners_;
};

}  // namespace navvi_rviz::plugin
