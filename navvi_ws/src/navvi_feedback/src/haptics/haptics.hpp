#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "navvi_config/field.hpp"
#include "navvi_feedback/haptics/rumble.hpp"
#include "types.hpp"

namespace navvi_feedback::haptics {

/// Defaults are ours; config/paper.yaml holds what the paper prints.
struct HapticsConfig {
  bool enabled = true;
  bool near = true;
  double strength = 1.0;
  double range = 5.0;   // m
  double center = 1.0;  // m
  std::string curve = "power";
  double exponent = 2.0;  ///< of the power curve
  double rear = 0.3;
  double duck = 0.3;
  bool rest_at_goal = true;
  bool patterns = true;
  bool instead_of_words = true;
  bool normalize = true;
  std::vector<std::string> classes = {"box",      "pedestal",     "worker",
                                      "forklift", "pallet_robot", "other"};
  double onset = 0.3;              // s
  double slew = 5.0;               // 1/s
  double range_hysteresis = 0.15;  // m
  double zone_hysteresis = 0.15;   // m
  double start_left = 0.04;
  double start_right = 0.06;
  double gain_left = 1.0;
  double gain_right = 1.0;
  std::vector<std::string> pads = {};

  void describe(navvi_config::Visitor& visit);
};

/// Which motor speaks (R-HAP-2): by the lateral place of the nearest thing in base_link.
enum class Zone { left, center, right };

/// The force of a thing at `gap` (R-HAP-3), before ramp, threshold and gain.
/// \param gap  m; less than 0 counts as 0
/// \return [0, 1]; 0 at `range` and beyond, and for a gap that is not finite. The log curve is
/// ln(1 + (1 - gap / range)), which peaks at ln 2; with `normalize` it is divided by ln 2.
[[nodiscard]] double rumble_force(const HapticsConfig& config, double gap);

/// Makes what is nearest felt (R-HAP-1 to 5), what is ahead more than what is behind: the pure law,
/// then what keeps a motor from jolting (onset ramp, slew limit) and from chattering (hysteresis at
/// the range and between the zones).
class Haptics {
 public:
  /// \throws navvi_config::ConfigError if `classes` holds a word that is no class, or `pads` what
  /// is not as described
  explicit Haptics(const HapticsConfig& config);

  /// From now on, but for the classes and the pads.
  void use(const HapticsConfig& config) {
    config_ = config;
    use_pad(pad_);
  }
  /// From here on the motors are those of this pad. \param pad  what identifies it
  void use_pad(const std::string& pad);

  /// \param things  all with finite numbers in base_link; in any order
  /// \param fresh  false when sensing is stale: the motors stop at once
  /// \param dt  s since the last call, >= 0
  [[nodiscard]] Rumble update(const std::vector<NearThing>& things, bool fresh, double dt);

 private:
  struct Felt {
    double lateral = 0.0;  ///< m, to the left
    double force = 0.0;    ///< [0, 1]
  };
  [[nodiscard]] std::optional<Felt> strongest(const std::vector<NearThing>& things) const;
  [[nodiscard]] Zone zone_of(double lateral) const;
  void stop();

  /// As in HapticsConfig.
  struct Motors {
    double start_left = 0.0;
    double start_right = 0.0;
    double gain_left = 1.0;
    double gain_right = 1.0;
  };

  HapticsConfig config_;
  std::map<std::string, Motors> pads_;
  std::string pad_;
  Motors motors_;
  std::vector<ThingClass> classes_;
  std::optional<Zone> zone_;  // of what is felt
  double felt_for_ = 0.0;  // s since the present onset
  Rumble force_;           // after the ramp, before threshold and gain
};

}  // namespace navvi_feedback::haptics
