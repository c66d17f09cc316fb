#include "read/sdf_value.hpp"

#include <cmath>
#include <locale>
#include <sstream>

#include "description/sentence.hpp"
#include "description/validate.hpp"

namespace navvi_sim::read {
namespace {

constexpr double kMost = WorldLimits::extent;

/// Of a length; zero is as wrong as a thing without extent is.
double checked_length(double value, const XmlElement& element) {
  if (!(value > 0.0 && value < kMost))
    refuse(element, "<" + element.name + "> is " + shortened(element.text) +
                        "; allowed is more than 0 and less than 1000 m");
  return value;
}

Eigen::Matrix3d rotation(const std::vector<double>& rpy) {
  return (Eigen::AngleAxisd(rpy[2], Eigen::Vector3d::UnitZ()) *
          Eigen::AngleAxisd(rpy[1], Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(rpy[0], Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
}

/// All numbers of the text, as a C++ stream reads them: "2-0.5" are two. None if anything else
/// stands there.
std::vector<double> stream_numbers(const XmlElement& element) {
  std::vector<double> values;
  std::istringstream stream(element.text);
  stream.imbue(std::locale::classic());
  while (!(stream >> std::ws).eof()) {
    double value = 0.0;
    if (!(stream >> value) || !std::isfinite(value)) return {};
    values.push_back(value);
  }
  return values;
}

}  // namespace

std::vector<double> numbers(const XmlElement& element, std::size_t count) {
  const std::vector<double> values = stream_numbers(element);
  if (values.size() != count)
    refuse(element, "<" + element.name + "> is \"" + shortened(element.text) + "\"; allowed " +
                        (count == 1 ? "is one finite number"
                                    : "are " + std::to_string(count) + " finite numbers") +
                        (element.text.find("${") == std::string::npos ? "" : "; run xacro first"));
  return values;
}

double number(const XmlElement& element) { return numbers(element, 1)[0]; }

Eigen::Vector3d vector3(const XmlElement& element) {
  const std::vector<double> v = numbers(element, 3);
  return {v[0], v[1], v[2]};
}

const XmlElement& required(const XmlElement& element, const std::string& child) {
  const XmlElement* found = element.child(child);
  if (found == nullptr)
    refuse(element, "<" + element.name + "> has no <" + child + ">; it needs one");
  return *found;
}

double length(const XmlElement& element, const std::string& child) {
  const XmlElement& found = required(element, child);
  return checked_length(number(found), found);
}

Eigen::Vector3d lengths(const XmlElement& element, const std::string& child) {
  const XmlElement& found = required(element, child);
  const Eigen::Vector3d values = vector3(found);
  for (const double value : values) checked_length(value, found);
  return values;
}

bool flag(const XmlElement& element, const std::string& child, bool otherwise) {
  const XmlElement* found = element.child(child);
  if (found == nullptr) return otherwise;
  if (found->text == "true" || found->text == "1") return true;
  if (found->text == "false" || found->text == "0") return false;
  refuse(*found,
         "<" + child + "> is \"" + shortened(found->text) + "\"; allowed are true and false");
}

Eigen::Isometry3d pose_value(const XmlElement& pose) {
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  if (pose.text.empty()) return result;
  const std::string format = pose.attribute("rotation_format");
  const bool quaternion = format == "quat_xyzw";
  if (!quaternion && !format.empty() && format != "euler_rpy")
    refuse(pose, "the rotation_format of <pose> is \"" + shortened(format) +
                     "\"; allowed are euler_rpy and quat_xyzw");
  std::vector<double> v = numbers(pose, quaternion ? 7 : 6);
  result.translation() = Eigen::Vector3d(v[0], v[1], v[2]);
  for (const double value : result.translation())
    if (!(std::abs(value) <= kMost))
      refuse(pose,
             "<pose> is \"" + shortened(pose.text) + "\"; allowed are positions up to 1000 m");
  if (quaternion) {
    const Eigen::Quaterniond turn(v[6], v[3], v[4], v[5]);
    if (!(turn.norm() > 1e-6 && std::isfinite(turn.norm())))
      refuse(pose, "<pose> has a quaternion of length 0; allowed are rotations");
    result.linear() = turn.normalized().toRotationMatrix();
    return result;
  }
  const bool degrees = pose.attribute("degrees") == "true" || pose.attribute("degrees") == "1";
  for (std::size_t i = 3; i < 6; ++i)
    v[i] = navvi_types::wrap(degrees ? navvi_types::radians(v[i]) : v[i]);
  result.linear() = rotation({v[3], v[4], v[5]});
  return result;
}

}  // namespace navvi_sim::read
