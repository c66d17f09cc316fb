#include "navvi_people/loop/guided_person.hpp"

#include <navvi_feedback/node/msg_conversion.hpp>
#include <navvi_types/msg_conversion.hpp>
#include <navvi_types/spoken.hpp>

#include "node/msg_conversion.hpp"

namespace navvi_people::loop {

namespace {

/// The lesson has taught the way of leading of the session.
people::SimulatedOperatorConfig taught(people::SimulatedOperatorConfig person,
                                       const navvi_feedback::core::GuideConfig& guide,
                                       bool speech) {
  person.lead = guide.lead(speech || guide.has_sounds());
  return person.typed();
}

}  // namespace

Spoken::Spoken(const std::string& phrases)
    : file(phrases), phrases(navvi_feedback::core::read_phrases(phrases)), listener(phrases) {}

GuidedPerson::GuidedPerson(const navvi_feedback::core::GuideConfig& guide,
                           const people::SimulatedOperatorConfig& person, int occasion, bool speech,
                           const Spoken& spoken)
    : guide_(guide, *spoken.phrases),
      person_(taught(person, guide, speech), spoken.listener, occasion),
      speech_(speech),
      heard_(speech || guide.has_sounds()) {}

std::optional<GuidedPerson::Command> GuidedPerson::feed_back(const people::StickAndButtons& hand,
                                                             const geometry_msgs::Transform& robot,
                                                             double time) {
  const ros::Time stamp(time);
  navvi_feedback::senses::Devices devices;
  if (const auto hands = navvi_feedback::node::from_msg(node::to_msg(hand, stamp)))
    devices.hands = *hands;
  devices.speaking = time < speaks_until_;
  devices.words = speech_;
  devices.sounds = heard_;
  devices.audio =
      heard_ ? navvi_feedback::senses::Link::alive : navvi_feedback::senses::Link::never;
  devices.robot = node::from_msg(robot);
  const auto told = guide_.update(devices, time);
  played_.cues.clear();
  played_.motors_due = false;
  if (!told) return std::nullopt;
  played_.motors = {told->rumble.left, told->rumble.right};
  played_.motors_due = told->rumble_due;
  if (told->voice.stop) speaks_until_ = time;
  if (told->voice.start) speaks_until_ = navvi_types::spoken_at(time, told->voice.start->size());
  std::vector<CueEvent> events = told->said;
  for (const auto& lasting : {told->felt, told->flowed})
    if (lasting) events.push_back(*lasting);
  for (const navvi_feedback::sounds::Play& play : told->plays)
    events.push_back(guide_.event_of(play));
  for (CueEvent& event : events) {
    event.stamp = navvi_types::to_ns(stamp);
    played_.cues.push_back(node::to_msg(event));
  }
  if (!told->command) return std::nullopt;
  return Command{*told->command, told->lag};
}

people::StickAndButtons GuidedPerson::act(double time, double dt) {
  if (played_.motors_due) person_.feel(played_.motors, time);
  for (const navvi_msgs::Cue& cue : played_.cues)
    if (const auto event = node::from_msg(cue))
      if (const auto heard = people::heard(*event)) person_.hear(*heard, time);
  return person_.update(time, dt);
}

}  // namespace navvi_people::loop
