#pragma once

#include <string>

#include "navvi_floor/occupancy_grid.hpp"
#include "navvi_floor/octomap_reader.hpp"
#include "navvi_floor/survey.hpp"

namespace navvi_floor {

/// A `.bt` or `.ot` file as octomap writes it (the header, then the stream of read_voxels()). Any
/// error is a sentence that names the file.
[[nodiscard]] Voxels read_octomap_file(const std::string& path);

struct GridFile {
  std::string error;  ///< a sentence that names the file
  OccupancyGrid grid;
  std::string source;  ///< what of the file is not used; may be empty
};

/// A map_server map: a `.yaml` file that names a picture beside it, a PGM of bytes. Of map_server's
/// modes the usual one, trinary, is read. Unknown keys are not used, as by map_server.
/// \param picture  read in place of the one that the file names; empty: that one
[[nodiscard]] GridFile read_grid_file(const std::string& path, const std::string& picture = {});

/// \param path  of a .bt, .ot or .yaml file \param picture  as for read_grid_file()
[[nodiscard]] MapSurvey survey_file(const std::string& path, const SurveyConfig& config,
                                    const std::string& picture = {});

}  // namespace navvi_floor
