#pragma once

#include "core/feedback_config.hpp"
#include "navvi_feedback/lockstep/guide.hpp"

namespace navvi_feedback::lockstep {

struct GuideConfig::Values : core::FeedbackConfig {};

}  // namespace navvi_feedback::lockstep
