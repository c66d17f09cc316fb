#pragma once

#include <navvi_types/cue_event.hpp>
#include <navvi_types/drive_state.hpp>
#include <navvi_types/guidance.hpp>
#include <navvi_types/link_state.hpp>
#include <navvi_types/zone.hpp>
#include <navvi_types/motion.hpp>
#include <navvi_types/scenario.hpp>
#include <navvi_types/thing.hpp>
#include <navvi_types/trial.hpp>

namespace navvi_feedback {
using navvi_types::About;
using navvi_types::Contact;
using navvi_types::Content;
using navvi_types::CueEvent;
using navvi_types::CueKind;
using navvi_types::CueStage;
using navvi_types::DriveState;
using navvi_types::Guidance;
using navvi_types::LinkState;
using navvi_types::ZoneState;
using navvi_types::NearThing;
using navvi_types::Odometry;
using navvi_types::Priority;
using navvi_types::Proximity;
using navvi_types::Scenario;
using navvi_types::ThingClass;
using navvi_types::TrialRequest;
using navvi_types::TrialState;
using navvi_types::Velocity;
}  // namespace navvi_feedback
