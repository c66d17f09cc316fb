#pragma once

#include <iterator>
#include <set>
#include <sstream>
#include <string>

namespace navvi_config {

/// Parameters, or whole groups, of earlier versions. Each has become a constant, or went with its
/// feature.
inline const std::set<std::string>& removed_keys() {
  static const std::set<std::string> all = [] {
    std::istringstream words(
        "absurd_factor attention/distracted attention/distractions attention/gives_up "
        "attention/idle_patience attention/patience box_fill camera ceiling cloud_points "
        "cues/blocker_gap cues/last_words cues/near/close cues/near/forget cues/near/hysteresis "
        "cues/patience cues/problem_repeat cues/recover cues/route/at_hand cues/route/coming "
        "cues/route/hysteresis_degrees cues/route/idle cues/route/in_the_way cues/route/long_leg "
        "cues/route/next_turn cues/route/pause cues/route/reach cues/route/repeat_direction "
        "cues/route/repeat_straight cues/route/same_corner cues/route/same_turn cues/route/settle "
        "cues/route/spot_radius cues/route/still_ahead cues/route/straight_lead cues/route/stray "
        "cues/route/turn_now cues/route/turning_rate cues/route/worse_degrees cues/starting "
        "cues/state_hold cues/stuck_angular cues/stuck_linear detection_radius drive/acceleration "
        "drive/arm_hold drive/assistance drive/deceleration drive/turn_acceleration "
        "driving/cruise driving/dead_zone driving/expo driving/full_speed driving/gain_error "
        "driving/noise driving/slow driving/turn_rate driving/veer driving/veer_spread "
        "feeling/delay feeling/recognised feeling/spread feeling/strong feeling/threshold "
        "feeling/touch forklift_speed gap gate/absurd_factor gate/neutral_angular "
        "gate/neutral_hold gate/neutral_linear guidance/close haptics/exponent haptics/steer "
        "hearing/fastest_speech hearing/masked hearing/mirrored hearing/misheard "
        "hearing/missed_sounds hearing/missed_words hearing/sound_reaction hearing/sound_spread "
        "hearing/word_reaction hearing/word_spread layout/forklift_speed "
        "layout/pallet_robot_speed layout/pause layout/worker_speed learning/bias_rate "
        "learning/rate lidar/dropouts lidar/field lidar/nearest lidar/rays lidar/x map/forget "
        "map/high map/hit map/miss map/slack map_rate markers memory/lost memory/span "
        "mesh/carve_moved mesh/threads mesh/tile_size mixer/reopen monitor moved movers narrowest "
        "neutral_angular neutral_hold neutral_linear obstacle_timeout octomap/free off_path "
        "others_rumble pallet_robot_speed pause period plan_timeout points pose_timeout "
        "replan/elbow_room replan/foresight replan/hold_choice replan/hold_detour replan/late_time "
        "replan/min_interval replan/notice_time replan/pause replan/slow_speed replan/slow_time "
        "replan/stop_room replan/tolerance replan/wait_distance robot/acceleration "
        "robot/angular_acceleration robot/angular_brake robot/brake robot/clearance "
        "robot/deceleration robot/height robot/imperfections/command_delay "
        "robot/imperfections/odometry_right robot/imperfections/slip_left "
        "robot/imperfections/slip_noise robot/imperfections/slip_right "
        "robot/imperfections/slip_time robot/imperfections/wheel_base robot/mass "
        "robot/max_turn_rate scenario/max_turns scenario/min_turns smoothing/attempts "
        "smoothing/clearance_weight smoothing/effort smoothing/keep smoothing/max_detour "
        "smoothing/max_stretch smoothing/tight smoothing/tight_weight smoothing/turn_price "
        "sounds/capture_radius sounds/sonar sounds/turn/begin sounds/turn/done sounds/turn/on "
        "sounds/turn/on_course sounds/under_words stale start_snap step tracks/agility "
        "tracks/gate tracks/keep tracks/moved tracks/rest tracks/settle tracks/sightings "
        "tracks/speed trust turning/over_ample turning/over_slight turning/over_spread "
        "turning/stop_delay turning/stop_spread widest worker_speed");
    return std::set<std::string>{std::istream_iterator<std::string>(words), {}};
  }();
  return all;
}

}  // namespace navvi_config
