#pragma once

#include <filesystem>

#include "navvi_sim/read/loaded_world.hpp"
#include "read/class_rules.hpp"
#include "read/model_places.hpp"

// Why SDF is read by our own reader, with libsdformat only as its judge in tests. libsdformat 12
// throws what is no std::exception at worlds that Gazebo itself saved. Ours says of everything that
// is wrong or left out what it is, in a sentence with file and line. World files come from
// anywhere, so ours also limits a file's size, its nesting, its numbers and where it may refer to.

namespace navvi_sim::read {

/// Reads a world in Gazebo's SDF, 1.4 to 1.11, by its collision geometry, as sdformat.org/spec says
/// it. One thing a top-level model; a model without shapes of its own gives one thing for each of
/// the models in it if these are several. A thing is classed by the first of its own name and the
/// names of the models and links in it that a rule fits. `model://` is looked for in `places`,
/// of which Gazebo's own come after the folders beside the world file. `floor_height` is that of
/// the largest level surface of the floor things.
///
/// An actor with a script walks its trajectories, as a person where it has no collision geometry.
/// What a plugin moves in Gazebo stands still. Models and links of a world that Gazebo saved stand
/// where its <state> says, and have the sizes that it says. Where nothing is named a floor, a
/// building may be its own. Storeys and ceilings above the floor are left out.
///
/// The notes say, with file and line, what is not taken over or is taken otherwise than in Gazebo:
/// plugins, tilted planes, links that are seen and touch nothing, models without collision
/// geometry or wholly under the floor. What means nothing here (lights, joints, sensors, ...) is
/// one last note.
/// \param missing  whether the world is read without its pieces that are missing or wrong: a model
/// or mesh that is not there, unreadable, or includes itself, a shape that is not known (a height
/// map), a number that is not finite or out of its range. The notes name them
/// \throws WorldError, with file and line, for a file that is missing or no SDF world, for all such
/// pieces together, and for a world without a floor or with much of it under the floor
[[nodiscard]] LoadedWorld read_sdf_world(const std::filesystem::path& file,
                                         const ModelPlaces& places, const ClassRules& rules,
                                         Missing missing);

}  // namespace navvi_sim::read
