#pragma once

#include <ros/node_handle.h>

#include "navvi_config/reader.hpp"

namespace navvi_config {

/// Everything on the parameter server under `node`'s namespace, as YAML; an empty map where there
/// is nothing.
[[nodiscard]] YAML::Node parameters(const ros::NodeHandle& node);

/// Reads `Config` from the parameters under `node`, usually the private NodeHandle("~").
/// \throws ConfigError as read() does
template <typename Config>
[[nodiscard]] Config load(const ros::NodeHandle& node) {
  Config config;
  read(config, parameters(node), "the parameters of " + node.getNamespace());
  return config;
}

}  // namespace navvi_config
