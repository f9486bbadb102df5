#include "surefoot/doctor/checks.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace surefoot::doctor {
namespace {

/// Does a word begin at this letter: "Left" in "FrontLeft", "FL" in "legFL", "Hip" in "FLHip"?
bool begins_word(const std::string& name, std::size_t at) {
  const auto is = [&](int (*kind)(int), std::size_t i) {
    return i < name.size() && kind(static_cast<unsigned char>(name[i])) != 0;
  };
  if (at == 0) return false;
  if (is(std::isalpha, at) != is(std::isalpha, at - 1)) return true;
  return is(std::isupper, at) && (is(std::islower, at - 1) || is(std::islower, at + 1));
}

/// The words of a name, in small letters: "front_right.hx" and "FrontRightHx" have three.
std::vector<std::string> words_of(const std::string& name) {
  std::vector<std::string> words(1);
  for (std::size_t i = 0; i < name.size(); ++i) {
    if (begins_word(name, i) && !words.back().empty()) words.emplace_back();
    const auto c = static_cast<unsigned char>(name[i]);
    if (std::isalnum(c) != 0) words.back() += static_cast<char>(std::tolower(c));
  }
  return words;
}

constexpr std::array<std::string_view, 2> kSides{"left", "right"};
constexpr std::array<std::string_view, 7> kPairs{"front", "fore",   "hind", "rear",
                                                 "back",  "middle", "mid"};

/// Adds the two words of one like "frontleft".
void split_joined(std::vector<std::string>& words) {
  std::vector<std::string> parts;
  for (const std::string& word : words) {
    for (const std::string_view side : kSides) {
      for (const std::string_view pair : kPairs) {
        const std::string first = std::string(pair) + std::string(side),
                          second = std::string(side) + std::string(pair);
        if (word.find(first) == std::string::npos && word.find(second) == std::string::npos)
          continue;
        parts.emplace_back(side);
        parts.emplace_back(pair);
      }
    }
  }
  words.insert(words.end(), parts.begin(), parts.end());
}

/// The word of two letters that tells a leg, as "fl" or "rh"; empty: none.
std::string short_name_in(const std::vector<std::string>& words) {
  constexpr std::string_view kSideLetters = "lr", kPairLetters = "fhbrm";
  const auto is_short_name = [&](const std::string& word) {
    const auto pair_of = [&](char side, char pair) {
      return kSideLetters.find(side) != std::string_view::npos &&
             kPairLetters.find(pair) != std::string_view::npos;
    };
    return word.size() == 2 && (pair_of(word[0], word[1]) || pair_of(word[1], word[0]));
  };
  const auto found = std::ranges::find_if(words, is_short_name);
  return found == words.end() ? "" : *found;
}

bool has_any(const std::vector<std::string>& words,
             std::initializer_list<std::string_view> wanted) {
  return std::ranges::any_of(words, [&](const std::string& word) {
    return std::ranges::find(wanted, word) != wanted.end();
  });
}

/// The leg that a joint's name tells, as robots are used to be described.
std::optional<Leg> leg_called(const std::string& joint, int num_legs) {
  std::vector<std::string> words = words_of(joint);
  split_joined(words);
  const auto place = [&](int pair, bool left) { return Leg{2 * pair + (left ? 0 : 1)}; };
  const int hind = num_legs / 2 - 1;
  const std::string name = short_name_in(words);
  if (!name.empty()) {
    const auto has = [&](char letter) { return name.find(letter) != std::string::npos; };
    const bool is_rear_right = name == "rr";
    const bool is_left = has('l'), is_right = has('r');
    const bool is_front = has('f');
    const bool is_hind = has('h') || has('b') || (is_left && is_right) || is_rear_right;
    if (is_front && is_left != is_right) return place(0, is_left);
    if (has('m') && is_left != is_right && hind == 2) return place(1, is_left);
    if (is_hind && (is_left || is_right)) return place(hind, is_left);
  }
  const bool left = has_any(words, {"left"});
  if (left == has_any(words, {"right"})) return std::nullopt;
  if (has_any(words, {"front", "fore"})) return place(0, left);
  if (has_any(words, {"hind", "rear", "back"})) return place(hind, left);
  if (hind == 2 && has_any(words, {"middle", "mid"})) return place(1, left);
  return std::nullopt;
}

struct Misnamed {
  Leg place, called;
};

std::string text(Leg leg, const Diagnosis& robot) {
  return std::string(leg_name(leg, static_cast<int>(robot.anatomy.legs->size())));
}

const model::UrdfJoint& first_joint_at(Leg leg, const Diagnosis& robot) {
  return (*robot.anatomy.legs)[index(leg)].joints[0];
}

/// Two legs that have each other's names, the rest being right.
void tell_swapped(const Misnamed& one, const Misnamed& other, Diagnosis& robot) {
  const model::UrdfJoint& joint = first_joint_at(one.place, robot);
  robot.findings.push_back(
      {Severity::warning, Confidence::likely, "joint \"" + joint.name + "\"", joint.line,
       text(one.place, robot) + " and " + text(other.place, robot) + " seem to be swapped: \"" +
           joint.name + "\" is at the place of " + text(one.place, robot) + ", and \"" +
           first_joint_at(other.place, robot).name + "\" at that of " + text(other.place, robot) +
           "; places count",
       "exchange the <origin>s of the two legs, or their names; does the driver have them in the "
       "same order?"});
}

void tell_misnamed(const Misnamed& leg, Diagnosis& robot) {
  const model::UrdfJoint& joint = first_joint_at(leg.place, robot);
  robot.findings.push_back(
      {Severity::warning, Confidence::guess, "joint \"" + joint.name + "\"", joint.line,
       "by its name it belongs to " + text(leg.called, robot) +
           ", but its hip is at the place of " + text(leg.place, robot) + "; places count",
       "does the base look along x, with y to the left?"});
}

}  // namespace

void check_names(Diagnosis& robot) {
  if (!robot.anatomy.legs) return;
  std::vector<Misnamed> wrong;
  for (const Leg leg : robot.anatomy.legs->legs()) {
    const std::optional<Leg> called =
        leg_called(first_joint_at(leg, robot).name, static_cast<int>(robot.anatomy.legs->size()));
    if (called && *called != leg) wrong.push_back({leg, *called});
  }
  const bool are_swapped =
      wrong.size() == 2 && wrong[0].called == wrong[1].place && wrong[1].called == wrong[0].place;
  if (are_swapped) return tell_swapped(wrong[0], wrong[1], robot);
  for (const Misnamed& leg : wrong) tell_misnamed(leg, robot);
}

}  // namespace surefoot::doctor
