#include <utility>

#include "core/guide_parts.hpp"

namespace navvi_feedback::core {
namespace {

constexpr double kPlans = 5.0;      // s; no planner needs longer
constexpr double kSameGoal = 0.05;  // m

/// m, in map; nullopt where the robot is not known to be there now
std::optional<Eigen::Vector2d> place_of(const Observation& now) {
  const bool lost = !now.measured || now.links.guidance != Link::alive ||
                    now.guidance->state == Guidance::State::pose_stale;
  if (lost || !now.devices.robot) return std::nullopt;
  return now.devices.robot->position;
}

}  // namespace

cues::Asked Guide::Parts::obey(const Observation& now, double dt, Output& out) {
  if (now.devices.keyboard && config.lead != "hand") menu.withdraw("hand");
  std::vector<drive::Button> pressed;
  for (const drive::Button button : now.pressed)
    if (!teacher.takes(button)) pressed.push_back(button);
  cues::Asked asked;
  for (const drive::Button button : pressed) {
    teacher.press(button, now.devices.keyboard);
    if (drive::is_question(button)) asked.question = button;
    if (button == drive::Button::goal && now.lead == Lead::hand && now.goal_angle)
      touch.answer(*now.goal_angle, now.goal_straight);
    const menu::Menu::Step step = menu.press(button);
    if (step.goal) {
      out.goal = step.goal;
      const std::uint32_t plans = now.guidance ? now.guidance->plans : 0;
      chosen = Chosen{*step.goal, *step.told, plans, kPlans};
    } else if (step.told) {
      asked.menu = step.told;
    }
    if (step.request) out.request = step.request;
    if (step.remember) asked.menu = remember(place_of(now), out);
    if (step.glossary) teacher.begin("glossary", now.devices.pad);
    if (step.change.empty()) continue;
    out.change = step.change;
    if (step.felt) touch.begin(haptics::Pattern::sample);
    if (step.heard) out.plays.push_back(sounds.sample(*step.heard));
  }
  if (const auto at = std::exchange(shown, std::nullopt); at && !menu.locked())
    asked.menu = remember(at, out);
  if (const auto answer = heed_planner(now, dt); answer && !asked.menu) asked.menu = answer;
  asked.menu_closed = menu.pass(dt);
  return asked;
}

std::optional<cues::Utterance> Guide::Parts::heed_planner(const Observation& now, double dt) {
  if (!chosen) return std::nullopt;
  const std::optional<Guidance>& plan = now.guidance;
  const bool answered = plan && plan->plans != chosen->plans &&
                        (plan->goal - chosen->goal).norm() < kSameGoal;
  chosen->left -= dt;
  if (!answered && chosen->left > 0.0) return std::nullopt;
  const cues::Utterance words = std::exchange(chosen, std::nullopt)->words;
  if (!answered) return cues::Utterance{{CueKind::menu_closed, About::menu_closed}};
  // Why there is no way is told by itself.
  if (!plan->leads() && plan->state != Guidance::State::arrived) return std::nullopt;
  return words;
}

cues::Utterance Guide::Parts::remember(const std::optional<Eigen::Vector2d>& at, Output& out) {
  if (config.places.empty()) return {{CueKind::menu_closed, About::place_no_file}};
  if (!at) return {{CueKind::menu_closed, About::place_no_pose}};
  out.place = menu.remember(*at, phrases);
  if (!out.place) return {CueKind::place_not_saved};
  cues::Utterance told{{CueKind::menu_closed, About::place_saved}};
  told.fillings.place_name = out.place->name;
  return told;
}

}  // namespace navvi_feedback::core
