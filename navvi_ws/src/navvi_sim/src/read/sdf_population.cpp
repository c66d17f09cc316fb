#include "read/sdf_population.hpp"

#include <cmath>
#include <sstream>

#include "description/hash.hpp"
#include "read/sdf_value.hpp"

namespace navvi_sim::read {
namespace {

constexpr int kMostModels = 1'000;

/// Of `kind` in the population. \throws PlaceError if it is not a whole number up to the most
int count_in(const XmlElement& parent, const char* kind) {
  const XmlElement& child = required(parent, kind);
  const double value = number(child);
  if (!(value >= 1.0 && value <= kMostModels) || value != std::floor(value))
    refuse(child, "<" + child.name + "> is " + child.text + "; allowed are 1 to " +
                      std::to_string(kMostModels));
  return static_cast<int>(value);
}

/// Points around the middle of the population, m.
using Points = std::vector<Eigen::Vector3d>;

Points grid(const XmlElement& distribution) {
  const int rows = count_in(distribution, "rows");
  const int columns = count_in(distribution, "cols");
  if (rows * columns > kMostModels)
    refuse(distribution, "a grid of " + std::to_string(rows) + " x " + std::to_string(columns) +
                             " is too large; allowed are " + std::to_string(kMostModels));
  const Eigen::Vector3d step = vector3(required(distribution, "step"));
  Points points;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column)
      points.emplace_back((column - (columns - 1) / 2.0) * step.x(),
                          (row - (rows - 1) / 2.0) * step.y(), 0.0);
  return points;
}

/// \param axis  0 to 2
Points row(const Eigen::Vector3d& size, int axis, int count) {
  Points points;
  for (int i = 0; i < count; ++i)
    points.push_back(Eigen::Vector3d::Unit(axis) * size[axis] *
                     (count == 1 ? 0.0 : static_cast<double>(i) / (count - 1) - 0.5));
  return points;
}

/// \param size  of the region; round where `is_round`
Points drawn(const Eigen::Vector3d& size, bool is_round, int count, const std::string& name) {
  Random random(mix_bytes(kHashBasis, name.data(), name.size()));
  Points points;
  while (points.size() < static_cast<std::size_t>(count)) {
    Eigen::Vector3d unit;
    for (int k = 0; k < 3; ++k) unit[k] = random.uniform(-0.5, 0.5);
    if (!is_round || unit.head<2>().norm() <= 0.5) points.push_back(unit.cwiseProduct(size));
  }
  return points;
}

Points points_of(const XmlElement& population) {
  const XmlElement& distribution = required(population, "distribution");
  const std::string type = required(distribution, "type").text;
  if (type == "grid") return grid(distribution);
  const XmlElement* const cylinder = population.child("cylinder");
  Eigen::Vector3d size;
  if (cylinder != nullptr)
    size << Eigen::Vector2d::Constant(2.0 * length(*cylinder, "radius")),
        length(*cylinder, "length");
  else
    size = lengths(required(population, "box"), "size");
  const int count = count_in(population, "model_count");
  for (int axis = 0; axis < 3; ++axis)
    if (type == std::string("linear-") + "xyz"[axis]) return row(size, axis, count);
  if (type != "random" && type != "uniform")
    refuse(distribution, "the distribution \"" + type +
                             "\" is not known here; allowed are random, uniform, grid, linear-x, "
                             "linear-y and linear-z");
  return drawn(size, cylinder != nullptr, count, population.attribute("name"));
}

std::string text_of(const Eigen::Vector3d& point, const XmlElement& pose) {
  std::istringstream words(pose.text);
  std::ostringstream text;
  text.precision(9);
  text << point.x() << ' ' << point.y() << ' ' << point.z();
  std::string word;
  for (int k = 0; words >> word; ++k)
    if (k >= 3) text << ' ' << word;
  return text.str();
}

}  // namespace

std::vector<XmlElement> models_of(const XmlElement& population) {
  const XmlElement& model = required(population, "model");
  XmlElement origin{"pose", "0 0 0 0 0 0", {}, {}, population.file, population.line};
  const XmlElement* const pose = population.child("pose");
  const Eigen::Isometry3d middle = pose_value(pose == nullptr ? origin : *pose);
  const XmlElement* const own = model.child("pose");
  if (own != nullptr && !own->text.empty()) origin.text = own->text;
  std::vector<XmlElement> models;
  for (const Eigen::Vector3d& point : points_of(population)) {
    XmlElement one = model;
    one.attributes["name"] = model.attribute("name") + "_" + std::to_string(models.size());
    XmlElement there = origin;
    there.text = text_of(middle * point, origin);
    one.replace(std::move(there));
    models.push_back(std::move(one));
  }
  return models;
}

}  // namespace navvi_sim::read
