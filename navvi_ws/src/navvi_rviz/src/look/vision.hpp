#pragma once

#include <map>
#include <string>
#include <vector>

#include "look/ribbon.hpp"

namespace navvi_rviz::look {

/// A palette for one way of seeing. What leads and what moves is filled with a bright colour; all
/// that stands around it is dark (luminance of at most 0.023, so that the path and the goal stand
/// out from it by 4.5:1) with a lighter edge.
struct Vision {
  std::map<std::string, Color> fill;  ///< by the namespace of a marker
  std::map<std::string, Color> edge;  ///< likewise, of what stands around
  Color bright, dark;                 ///< of the two edges around what matters
  Color text, plate;
  double width = 1.0;       ///< times the width of the path, and of the ring around the goal
  double text_height = 26;  ///< px, of capital letters on a screen of 1080 rows
};

/// \return nullptr: there is none of that name
[[nodiscard]] const Vision* find_vision(const std::string& name);
[[nodiscard]] std::vector<std::string> vision_names();

}  // namespace navvi_rviz::look
