#pragma once

#include <rosbag/bag.h>

#include <filesystem>
#include <navvi_people/loop/closed_loop.hpp>
#include <navvi_types/scenario.hpp>
#include <vector>

#include "record/row.hpp"

namespace navvi_study::batch {

/// The bag of a closed loop: what its parts tell each other, under the names of a live session.
class LoopBag {
 public:
  /// \throws rosbag::BagException if it cannot be written
  LoopBag(const std::filesystem::path& path, const navvi_people::loop::ClosedLoop& loop);

  /// As sim_node publishes it, but for the places, which no reader of a bag needs.
  [[nodiscard]] static navvi_types::Scenario scenario_of(
      const navvi_people::loop::ClosedLoop& loop);

  /// Call it after every step of the loop. \param rows  new ones of the journal
  void watch(const std::vector<record::Row>& rows);

 private:
  template <typename Message>
  void write(const char* topic, const Message& message);

  const navvi_people::loop::ClosedLoop& loop_;
  rosbag::Bag bag_;
  std::size_t hashes_ = 0;    ///< in the bag, as are
  std::size_t commands_ = 0;
  int drive_ = -1;  ///< the last state and reason
};

}  // namespace navvi_study::batch
