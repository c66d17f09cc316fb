#pragma once

#include <functional>
#include <string>
#include <vector>

#include "look/vision.hpp"

namespace navvi_rviz::plugin {

/// What a person chose, for all displays and the panel in this process: the vision, first from the
/// parameter ~vision. Only the GUI's thread may use it.
class Chosen {
 public:
  static Chosen& shared();

  [[nodiscard]] const look::Vision& vision() const { return *look::find_vision(name_); }
  [[nodiscard]] const std::string& name() const { return name_; }
  /// An unknown name changes nothing.
  void choose(const std::string& name);
  /// Calls `tell` after each change, as long as this process lives.
  void on_change(std::function<void()> tell) { listeners_.push_back(std::move(tell)); }

 private:
  Chosen();

  std::string name_ = "high_contrast";
  std::vector<std::function<void()>> listeners_;
};

}  // namespace navvi_rviz::plugin
