#include "navvi_floor/map_file.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <navvi_config/reader.hpp>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "navvi_floor/map_survey.hpp"

namespace navvi_floor {
namespace {

constexpr std::size_t kMaxHeader = 4096;         // bytes
constexpr std::size_t kMaxPicture = 64U << 20U;  // bytes
constexpr std::size_t kMaxPictureSide = 32768;   // pixels

/// A sentence that names the file.
using FileError = std::runtime_error;

std::string load(const std::string& path, std::size_t most) {
  std::error_code failed;
  if (!std::filesystem::is_regular_file(path, failed))
    throw FileError(path + (std::filesystem::exists(path, failed) ? ": not a regular file"
                                                                  : ": there is no such file"));
  const auto size = std::filesystem::file_size(path, failed);
  if (failed || size > most)
    throw FileError(path + ": the file is larger than " + std::to_string(most >> 20U) + " MiB");
  std::ifstream file(path, std::ios::binary);
  std::string bytes(static_cast<std::size_t>(size), '\0');
  if (!file.read(bytes.data(), static_cast<std::streamsize>(size)))
    throw FileError(path + ": the file cannot be read");
  return bytes;
}

/// The lines before "data".
struct Header {
  MapBytes map;
  std::string nodes = "?";  ///< octomap's count of them: the stream does not need it
  std::size_t length = 0;   ///< bytes, the line "data" included
};

Header read_header(const std::string& path, const std::string& bytes) {
  Header out;
  std::istringstream stream(bytes.substr(0, kMaxHeader));
  std::string line;
  std::getline(stream, line);
  if (line.rfind("# Octomap OcTree binary file", 0) == 0) {
    out.map.binary = true;
  } else if (line.rfind("# Octomap OcTree file", 0) == 0) {
    out.map.binary = false;
  } else {
    throw FileError(path + ": the first line is not that of an OctoMap file (.bt or .ot)");
  }
  while (std::getline(stream, line)) {
    if (line.empty() || line[0] == '#') continue;
    if (line == "data") {
      out.length = stream.eof() ? bytes.size() : static_cast<std::size_t>(stream.tellg());
      return out;
    }
    const std::size_t space = line.find(' ');
    const std::string key = line.substr(0, space);
    const std::string value = space == std::string::npos ? "" : line.substr(space + 1);
    if (key == "id") {
      out.map.id = value;
    } else if (key == "res") {
      out.map.resolution = YAML::Node(value).as<double>(0.0);
    } else if (key == "size") {
      out.nodes = value;
    } else {
      throw FileError(path + ": the header has a line \"" + printable(key) +
                      "\"; id, size, res and data are allowed");
    }
  }
  throw FileError(path + ": the header has no line \"data\"");
}

/// A grey picture, row by row from the top.
struct Picture {
  std::size_t width = 0;
  std::size_t height = 0;
  double white = 255.0;
  std::string pixels;
};

/// A PGM picture of bytes (P5); comments run from # to the end of the line.
Picture read_picture(const std::string& path) {
  const std::string bytes = load(path, kMaxPicture);
  std::istringstream stream(bytes);
  std::string kind;
  std::size_t numbers[3] = {};
  stream >> std::setw(3) >> kind;
  for (std::size_t& number : numbers) {
    while ((stream >> std::ws).peek() == '#')
      stream.ignore(static_cast<std::streamsize>(bytes.size()), '\n');
    stream >> number;
  }
  const auto [width, height, white] = numbers;
  if (kind != "P5" || !stream || white == 0 || white > 255)
    throw FileError(path + ": this is not a PGM picture of bytes (P5) of up to 255 levels");
  const bool fits = width <= kMaxPictureSide && height <= kMaxPictureSide;
  stream.get();  // one white space
  Picture out{width, height, static_cast<double>(white), {}};
  if (fits && stream) out.pixels = bytes.substr(static_cast<std::size_t>(stream.tellg()));
  if (out.pixels.empty() || out.pixels.size() < width * height)
    throw FileError(path + ": the picture should have " + std::to_string(width) + " x " +
                    std::to_string(height) + " pixels, and it has not; 32768 a side are allowed");
  return out;
}

struct GridDescription {
  std::string image;
  double resolution = 0.0;
  std::vector<double> origin;
  int negate = 0;
  double occupied_thresh = kOccupiedAbove;
  double free_thresh = kFreeBelow;
  std::string mode = "trinary";

  void describe(navvi_config::Visitor& visit) {
    using navvi_config::Range;
    visit(image, "image", navvi_config::Any{}, "", "a PGM picture of bytes");
    visit(resolution, "resolution", Range{kMinResolution, kMaxResolution}, "m", "side of a pixel");
    visit(origin, "origin", navvi_config::Any{}, "m, m, rad", "lower left corner: x, y, yaw");
    visit(negate, "negate", Range{0.0, 1.0}, "", "1: white is occupied");
    visit(occupied_thresh, "occupied_thresh", Range{0.0, 1.0}, "", "darker is occupied");
    visit(free_thresh, "free_thresh", Range{0.0, 1.0}, "", "lighter is free");
    visit(mode, "mode", navvi_config::OneOf{{"trinary"}}, "", "how grey is understood");
  }
};

OccupancyGrid grid_of(const GridDescription& how, const Picture& picture) {
  OccupancyGrid grid;
  grid.width = static_cast<int>(picture.width);
  grid.height = static_cast<int>(picture.height);
  grid.resolution = how.resolution;
  grid.origin = {how.origin[0], how.origin[1]};
  grid.yaw = how.origin.size() > 2 ? how.origin[2] : 0.0;
  grid.cells.reserve(picture.pixels.size());
  for (std::size_t y = picture.height; y-- > 0;) {  // the picture's top is the map's far side
    for (std::size_t x = 0; x < picture.width; ++x) {
      const double light =
          static_cast<unsigned char>(picture.pixels[y * picture.width + x]) / picture.white;
      const double occupied = how.negate != 0 ? light : 1.0 - light;
      grid.cells.push_back(occupied > how.occupied_thresh ? std::int8_t{100}
                           : occupied < how.free_thresh   ? std::int8_t{0}
                                                          : std::int8_t{-1});
    }
  }
  return grid;
}

}  // namespace

Voxels read_octomap_file(const std::string& path) {
  Voxels out;
  try {
    const std::string bytes = load(path, kMaxMapBytes + kMaxHeader);
    Header header = read_header(path, bytes);
    header.map.data = reinterpret_cast<const std::int8_t*>(bytes.data()) + header.length;
    header.map.size = bytes.size() - header.length;
    out = read_voxels(header.map);
    out.source = printable(header.map.id) + " of " + printable(header.nodes) + " nodes";
    if (!out.error.empty()) out.error.insert(0, path + ": ");
  } catch (const FileError& error) {
    out.error = error.what();
  }
  return out;
}

GridFile read_grid_file(const std::string& path, const std::string& instead) {
  try {
    GridDescription how;
    YAML::Node used;
    std::string unused;
    const auto rows =
        navvi_config::table_of([&](navvi_config::Visitor& visit) { how.describe(visit); });
    for (const auto& entry : navvi_config::load_yaml(path)) {
      const auto key = entry.first.as<std::string>("");
      const bool known = std::any_of(rows.begin(), rows.end(),
                                     [&](const navvi_config::Row& row) { return row.key == key; });
      if (known)
        used.force_insert(entry.first, entry.second);
      else
        unused += (unused.empty() ? "without its unknown keys: " : ", ") + printable(key);
    }
    navvi_config::read(how, used, path);
    if (how.image.empty() || how.resolution <= 0.0 || how.origin.size() < 2)
      throw FileError(path + ": a map_server map names its image, resolution and origin");
    if (how.occupied_thresh < how.free_thresh)
      throw FileError(path +
                      ": occupied_thresh is below free_thresh; allowed is the same or above");
    auto picture = std::filesystem::path(path).parent_path() / how.image;
    // Many maps name their picture in a folder of their author, and lie beside it.
    std::error_code failed;
    const auto beside = std::filesystem::path(path).parent_path() / picture.filename();
    if (!std::filesystem::exists(picture, failed) && std::filesystem::exists(beside, failed))
      picture = beside;
    if (!instead.empty()) picture = instead;
    return {{}, grid_of(how, read_picture(picture.string())), unused};
  } catch (const std::runtime_error& error) {  // FileError or ConfigError
    return {error.what(), {}, {}};
  }
}

MapSurvey survey_file(const std::string& path, const SurveyConfig& config,
                      const std::string& picture) {
  const std::string ending = std::filesystem::path(path).extension().string();
  MapSurvey out;
  if (ending == ".bt" || ending == ".ot") {
    const Voxels voxels = read_octomap_file(path);
    out.error = voxels.error;
    if (!out.error.empty()) return out;
    out = survey_map(voxels, config);
    out.source = voxels.source;
  } else if (ending == ".yaml" || ending == ".yml") {
    const GridFile file = read_grid_file(path, picture);
    out.error = file.error;
    if (!out.error.empty()) return out;
    out = read_grid(file.grid, config);
    out.source = file.source;
  } else {
    out.error = "maps end in .bt, .ot (OctoMap) or .yaml (map_server)";
  }
  if (!out.error.empty()) out.error.insert(0, path + ": ");
  return out;
}

}  // namespace navvi_floor
