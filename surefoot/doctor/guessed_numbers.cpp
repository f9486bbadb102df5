#include "surefoot/doctor/guessed_numbers.hpp"

#include "surefoot/base/formatted.hpp"
#include "surefoot/doctor/limit_guesses.hpp"

#include <algorithm>

namespace surefoot::doctor {
namespace {

/// Is this limit of a joint a guess that the file has as a number?
bool is_taken(const Diagnosis& robot, const LimitGuess& guess, const model::UrdfJoint& joint,
              Guesses guesses) {
  const LimitGaps gaps = gaps_of(robot, joint);
  const bool is_position = guess.gap == &LimitGaps::position;
  if (is_position && gaps.turns) return true;
  return guesses == Guesses::as_numbers && gaps.*guess.gap;
}

/// The joints of one kind: " LF_HAA RF_HAA", or " each HAA"; empty: none.
std::string joints_of(const Diagnosis& robot, const LimitGuess& guess, std::size_t kind,
                      Guesses guesses) {
  std::string names;
  std::size_t count = 0;
  for (const FoundLeg& leg : *robot.anatomy.legs) {
    if (!is_taken(robot, guess, leg.joints[kind], guesses)) continue;
    names += " " + leg.joints[kind].name;
    ++count;
  }
  return count == robot.anatomy.legs->size() ? " each " + std::string(kJointNames[kind]) : names;
}

/// "limits.torque 24.7 N·m of LF_HAA RF_HAA", "limits.position_max 1.2 rad of each HAA, 2.6 …".
void add_limits(const Diagnosis& robot, const LimitGuess& guess, Guesses guesses,
                std::vector<std::string>& numbers) {
  std::string text;
  double last = kNaN;
  for (std::size_t kind = 0; kind < kJointsPerLeg; ++kind) {
    const std::string joints = joints_of(robot, guess, kind, guesses);
    if (joints.empty()) continue;
    if (guess.numbers[kind] != last) {
      text += (text.empty() ? "" : ",") + formatted(" %.3g %s of", guess.numbers[kind], guess.unit);
    }
    last = guess.numbers[kind];
    text += joints;
  }
  if (!text.empty()) numbers.push_back(std::string("limits.") + guess.key + text);
}

void add_arm(const Diagnosis& robot, const LimitGuess& guess, const Limb& arm, Guesses guesses,
             std::vector<std::string>& numbers) {
  std::string names;
  for (const model::UrdfJoint& joint : arm.joints) {
    const bool is_position = guess.gap == &LimitGaps::position;
    const bool is_given = !(is_position ? has_no_stops(joint) : is_missing(joint.*guess.given));
    if (!is_given && is_taken(robot, guess, joint, guesses)) names += " " + joint.name;
  }
  if (names.empty()) return;
  numbers.push_back(std::string("arms: ") + guess.key +
                    formatted(" %.3g %s of", guess.of_arm, guess.unit) + names);
}

void add_radius(const PerLeg<FoundLeg>& legs, Guesses guesses, std::vector<std::string>& numbers) {
  if (std::ranges::any_of(legs, [](const auto& leg) { return leg.foot.guessed_from.empty(); }))
    return;
  const Foot& foot = legs[0].foot;
  if (foot.guessed_from == kNoShape && guesses == Guesses::as_comments) return;
  numbers.push_back(formatted("foot.radius %.3g m", foot.radius));
}

}  // namespace

std::vector<std::string> guessed_numbers(const Diagnosis& robot, Guesses guesses) {
  std::vector<std::string> numbers;
  for (const LimitGuess& guess : limit_guesses(robot)) {
    if (robot.anatomy.legs) add_limits(robot, guess, guesses, numbers);
    for (const Limb& limb : robot.anatomy.others)
      if (limb.is_arm) add_arm(robot, guess, limb, guesses, numbers);
  }
  if (robot.anatomy.legs) add_radius(*robot.anatomy.legs, guesses, numbers);
  if (robot.anatomy.flat_legs && robot.anatomy.flat_legs->sole.is_guess)
    numbers.push_back(formatted("foot.size %.3g by %.3g m", robot.anatomy.flat_legs->sole.size.x(),
                                robot.anatomy.flat_legs->sole.size.y()));
  return numbers;
}

}  // namespace surefoot::doctor
