#pragma once

#include <stdexcept>

namespace navvi_sim {

/// A sentence that says which file or thing is wrong, what is wrong with it, and what is allowed.
class WorldError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace navvi_sim
