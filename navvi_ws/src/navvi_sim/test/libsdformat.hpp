#pragma once

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <sdf/sdf.hh>
#include <vector>

namespace navvi_sim::read {

/// A collision as libsdformat tells it.
struct JudgedCollision {
  Eigen::Isometry3d pose;  ///< in map
  const sdf::Geometry* geometry;
};

inline Eigen::Isometry3d isometry(const ignition::math::Pose3d& pose) {
  Eigen::Isometry3d result(
      Eigen::Quaterniond(pose.Rot().W(), pose.Rot().X(), pose.Rot().Y(), pose.Rot().Z()));
  result.translation() = Eigen::Vector3d(pose.Pos().X(), pose.Pos().Y(), pose.Pos().Z());
  return result;
}

template <typename Element>
Eigen::Isometry3d resolved(const Element& element) {
  ignition::math::Pose3d pose;
  const sdf::Errors errors = element.SemanticPose().Resolve(pose);
  for (const sdf::Error& error : errors) ADD_FAILURE() << error.Message();
  return isometry(pose);
}

/// Of all collisions, those of links before those of nested models.
/// \param pose  of the model in map
inline void gather(const sdf::Model& model, const Eigen::Isometry3d& pose,
                   std::vector<JudgedCollision>& collisions) {
  for (std::uint64_t i = 0; i < model.LinkCount(); ++i) {
    const sdf::Link& link = *model.LinkByIndex(i);
    for (std::uint64_t k = 0; k < link.CollisionCount(); ++k) {
      const sdf::Collision& collision = *link.CollisionByIndex(k);
      collisions.push_back({pose * resolved(link) * resolved(collision), collision.Geom()});
    }
  }
  for (std::uint64_t i = 0; i < model.ModelCount(); ++i) {
    const sdf::Model& inner = *model.ModelByIndex(i);
    gather(inner, pose * resolved(inner), collisions);
  }
}

}  // namespace navvi_sim::read
