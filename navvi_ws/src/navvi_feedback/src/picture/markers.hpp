#pragma once

#include <visualization_msgs/MarkerArray.h>

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "cues/phrases.hpp"
#include "types.hpp"

namespace navvi_feedback::picture {

/// What is drawn of the guidance (R-VIS-1, 2): the path as a purple strip on a wider white one, the
/// goal as a red pole in a white ring with its word, and the next turn as an arrow with its words,
/// and over a slow connection a white ring where the robot will stand if the stick is let go now.
/// No two things differ by colour alone. Namespaces path, goal, turn, stop, and label for the words.
///
/// Every call names every marker, with DELETE for what is not there: without guidance that follows
/// a path, nothing is.
/// \param path  m, in map
/// \param words  of the language of the session
/// \param turn  what is said of the next turn; empty while the person is to do something else
/// \param stop  m, in map
[[nodiscard]] visualization_msgs::MarkerArray guide_markers(
    const std::optional<Guidance>& guidance, const std::vector<Eigen::Vector2d>& path,
    const cues::Phrases& words, const std::string& turn,
    const std::optional<Eigen::Vector2d>& stop);

/// What shows a path that nobody is led along yet: its goal, and no turn.
/// \param path  m, in map, of at least one place
[[nodiscard]] Guidance preview_of(const std::vector<Eigen::Vector2d>& path);

/// Gives every marker the time.
void stamp(visualization_msgs::MarkerArray& markers, const ros::Time& time);

}  // namespace navvi_feedback::picture
