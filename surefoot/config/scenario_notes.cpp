#include "surefoot/config/scenario_notes.hpp"

#include "surefoot/base/formatted.hpp"
#include "surefoot/config/robot_guesses.hpp"
#include "surefoot/gaits/command_limits.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <string_view>
#include <utility>

namespace surefoot::config {
namespace {

constexpr std::string_view kRandomisePrefix = "randomise.";
constexpr std::string_view kActuators = "actuators.";
/// Options of drives with motor and spring, level 2.
constexpr std::array<std::string_view, 3> kOfSpring{"actuators.spring.", "actuators.rotor.",
                                                    "actuators.torque_loop."};

/// Notes pushes, lifts or faults that begin after the end of the run.
template <typename Entry>
void note_late(const ConfigNode& tree, const char* section, const char* key,
               const std::vector<Entry>& entries, const Scenario& scenario,
               std::vector<std::string>& notes) {
  const ConfigNode* node = tree.find(section);
  const ConfigNode* named = node == nullptr ? nullptr : node->find(key);
  if (named == nullptr) return;
  std::size_t i = 0;
  for (const auto& [name, entry] : named->members) {
    if (entry.kind == ConfigNode::Kind::null) continue;
    const double time = entries[i++].time;
    if (time < scenario.duration) continue;
    notes.push_back(formatted("%s.%s.%s begins at %g s; the run ends at %g s", section, key,
                              name.c_str(), time, scenario.duration));
  }
}

/// Notes assigned ranges of keys whose value is assigned too.
void note_undrawn(const std::vector<std::string>& assigned, std::vector<std::string>& notes) {
  for (const std::string& path : assigned) {
    if (!path.starts_with(kRandomisePrefix)) continue;
    const std::string key = path.substr(kRandomisePrefix.size());
    if (std::ranges::find(assigned, key) == assigned.end()) continue;
    notes.push_back(formatted("%s draws nothing, as %s is set", path.c_str(), key.c_str()));
  }
}

void note_unused_actuator(const std::vector<std::string>& assigned,
                          const simulation::ActuatorOptions& actuators,
                          std::vector<std::string>& notes) {
  for (const std::string& path : assigned) {
    if (!path.starts_with(kActuators) || path == "actuators.model") continue;
    const auto begins_path = [&](std::string_view part) { return path.starts_with(part); };
    if (actuators.model == simulation::ActuatorModel::ideal) {
      notes.push_back(path + " changes nothing, as actuators.model is ideal");
    } else if (actuators.level == 1 && std::ranges::any_of(kOfSpring, begins_path)) {
      notes.push_back(path +
                      " changes nothing, as actuators.level is 1; level 2 has motor and spring");
    }
  }
}

/// Options of a command's gait; null where the speed chooses.
const gaits::PlannerOptions* gait_of(const UserCommand& user, const Scenario& scenario) {
  const control::ControllerOptions& controller = scenario.controller;
  const int gait = user.gait == UserCommand::kOwnGait ? controller.first_gait : user.gait;
  if (gait == UserCommand::kAutoGait) return nullptr;
  return gait == UserCommand::kOwnGait ? &controller.planner
                                       : &controller.gaits[static_cast<std::size_t>(gait)].options;
}

/// Notes the first command that is faster than its gait, by a clock, can go.
void note_too_fast(const Scenario& scenario, std::vector<std::string>& notes) {
  for (const TimedCommand& command : scenario.commands) {
    const UserCommand& user = command.user;
    const gaits::PlannerOptions* gait = gait_of(user, scenario);
    if (gait == nullptr || !gait->rhythm.enabled || !user.walk) continue;
    const double speed = gaits::foot_speed(user, gait->stance.half_length);
    if (speed <= gait->rhythm.speed_max) continue;
    notes.push_back(
        formatted("user commands feet of %g m/s at %g s; the gait's speed_max is %g "
                  "m/s, so it walks slower",
                  speed, command.time, gait->rhythm.speed_max));
    return;
  }
}

/// A planner of the user's own, or a stack that comes later, may follow it.
void note_vain_reach(const Scenario& scenario, std::vector<std::string>& notes) {
  if (control::follows_tip(scenario.controller.stack)) return;
  const auto reaches = std::ranges::find_if(
      scenario.commands, [](const TimedCommand& command) { return command.user.reach.arm >= 0; });
  if (reaches == scenario.commands.end()) return;
  notes.push_back(
      formatted("at %g s, reach.arm: no task of the stack \"%s\" follows an arm's tip; "
                "one with frame_position, without frame, would, or one without tasks "
                "for arms, which then gets them",
                reaches->time, scenario.controller.stack.name.c_str()));
}

}  // namespace

std::vector<std::string> scenario_notes(const ConfigNode& tree, const Scenario& scenario) {
  std::vector<std::string> assigned;
  for (const std::string& assignment : scenario.assignments)
    assigned.push_back(assigned_path(assignment));

  std::vector<std::string> notes;
  const simulation::PlantOptions& plant = scenario.plant;
  note_late(tree, "disturbances", "pushes", plant.disturbances.pushes, scenario, notes);
  note_late(tree, "disturbances", "lifts", plant.disturbances.lifts, scenario, notes);
  note_late(tree, "sensors", "faults", plant.sensors.faults, scenario, notes);
  note_undrawn(assigned, notes);
  note_unused_actuator(assigned, plant.actuators, notes);
  note_too_fast(scenario, notes);
  note_vain_reach(scenario, notes);
  if (std::string guessed = guessed_note(scenario); !guessed.empty())
    notes.push_back(std::move(guessed));
  std::ranges::copy(control::missing_physics(scenario.controller.stack), std::back_inserter(notes));
  return notes;
}

}  // namespace surefoot::config
