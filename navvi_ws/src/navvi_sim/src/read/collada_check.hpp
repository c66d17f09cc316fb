#pragma once

#include <cstddef>
#include <filesystem>

namespace tinyxml2 {
class XMLElement;
}

namespace navvi_sim::read {

/// Refuses Collada that its reader would crash on or never end with: nodes that instance
/// themselves, or that unfold to more than 100 000 pieces; nodes more than 200 deep
/// (tinyxml2 may refuse fewer). What else is wrong is left to the reader.
/// \param bytes  of the text
/// \throws WorldError that names `file`
void check_collada(const std::filesystem::path& file, const tinyxml2::XMLElement& root,
                   std::size_t bytes);

}  // namespace navvi_sim::read
