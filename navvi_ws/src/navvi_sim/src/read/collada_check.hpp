#pragma once

#include <filesystem>
#include <string>

namespace navvi_sim::read {

/// Refuses a Collada text that its reader would crash on or never end with: nodes that instance
/// themselves, or that unfold to more than 100 000 pieces; nodes more than 200 deep, elements more
/// than 1000 deep; a document type. What else is wrong is left to the reader.
/// \throws WorldError that names `file`
void check_collada(const std::filesystem::path& file, const std::string& text);

}  // namespace navvi_sim::read
