#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <map>
#include <navvi_types/thing.hpp>
#include <vector>

namespace navvi_sim::physics {

/// The least distance between the robot's body and one thing near it.
struct Touch {
  std::size_t thing;      ///< index in WorldDescription::things
  double distance;        ///< m, negative where they overlap
  Eigen::Vector3d point;  ///< m, on the thing, in map
};

using ContactCounts = std::map<navvi_types::ThingClass, std::uint32_t>;

/// Counts each contact once, at its begin. A thing counts again only after it was apart from the
/// robot for a while.
class ContactCounter {
 public:
  static constexpr double kTouching = 0.003;  ///< m, nearer is contact
  static constexpr double kApart = 0.02;      ///< m, farther is apart
  static constexpr double kApartFor = 0.2;    ///< s

  /// \param touches  at most one per thing, ordered by thing; a thing that is absent is far
  /// \param classes  of all things
  /// \param speed    m/s, the robot's before any contact that begins now
  /// \param dt       s, since the last call
  /// \return contacts that began, without the thing's name, the robot's pose and a stamp
  [[nodiscard]] std::vector<navvi_types::Contact> update(
      const std::vector<Touch>& touches, const std::vector<navvi_types::ThingClass>& classes,
      double speed, double dt);

  [[nodiscard]] const ContactCounts& counts() const { return counts_; }
  /// Things in contact, or not long enough apart, with the time they have been apart in s.
  [[nodiscard]] const std::map<std::size_t, double>& held() const { return held_; }

 private:
  std::map<std::size_t, double> held_;
  ContactCounts counts_;
  std::uint32_t seq_ = 0;
};

}  // namespace navvi_sim::physics
