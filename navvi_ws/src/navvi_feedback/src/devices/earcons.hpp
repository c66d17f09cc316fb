#pragma once

#include "devices/voice.hpp"
#include "navvi_feedback/sounds/earcon.hpp"

namespace navvi_feedback::devices {

/// An earcon's samples, made of a few notes. It begins and ends without a click.
[[nodiscard]] Sound synthesize(sounds::Earcon earcon);

}  // namespace navvi_feedback::devices
