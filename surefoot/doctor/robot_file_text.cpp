#include "surefoot/doctor/robot_file_text.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/base/formatted.hpp"
#include "surefoot/doctor/checks.hpp"
#include "surefoot/logging/output_files.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace surefoot::doctor {
namespace {

/// Names as YAML text, so that ": ", "#" and spaces in them do no harm.
std::string quoted(const std::string& text) {
  if (text.find_first_not_of(
          "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_/.:-") ==
          std::string::npos &&
      !text.ends_with(':') &&
      text.find_first_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ/.") == 0)
    return text;
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result + "\"";
}

std::string urdf_seen_from(const Diagnosis& robot, const std::filesystem::path& folder) {
  if (robot.given.find("://") != std::string::npos) return robot.given;
  const std::filesystem::path urdf = std::filesystem::weakly_canonical(robot.urdf.path);
  return urdf.lexically_proximate(std::filesystem::weakly_canonical(folder)).string();
}

/// The foot whose sphere stands for all: the first that has one.
const Foot& foot_of_all(const PerLeg<FoundLeg>& legs) {
  const auto has_sphere = [](const FoundLeg& leg) { return leg.foot.guessed_from.empty(); };
  const auto found = std::ranges::find_if(legs, has_sphere);
  return found == legs.end() ? legs[0].foot : found->foot;
}

std::string foot_lines(const Foot& foot, Guesses guesses) {
  const bool has_shape = foot.guessed_from != kNoShape;
  const bool is_comment = !has_shape && guesses == Guesses::as_comments;
  std::string text = "foot:\n";
  text += is_comment ? "  # " : "  ";
  text += formatted("radius: %.6g", foot.radius) + "               # m";
  if (!foot.guessed_from.empty())
    text += "; a guess, as the foot has no sphere but " + foot.guessed_from + ": measure it";
  text += "\n";
  if (!foot.center.isZero(1e-9)) {
    text += formatted("  center: [%.6g, %.6g, %.6g]  # m, in the foot frame\n", foot.center.x(),
                      foot.center.y(), foot.center.z());
  }
  return text;
}

/// One limit of a leg that the URDF lacks, as a guess for HAA, HFE and KFE.
struct Guess {
  const char* key;
  bool LimitGaps::* gap;
  std::array<double, kJointsPerLeg> numbers;
  const char* help;
};

/// As ANYmal B's are, for a robot of this size.
std::vector<Guess> guesses_for(const Diagnosis& robot) {
  const Scale scale = robot.proportions ? model::scale_of(*robot.proportions) : Scale();
  const double torque = 40.0 * scale.torque(), velocity = 15.0 * scale.rate();
  return {{"torque", &LimitGaps::effort, {torque, torque, torque}, "N·m, of the drives"},
          {"velocity",
           &LimitGaps::velocity,
           {velocity, velocity, velocity},
           "rad/s, where no torque is left"},
          {"position_min", &LimitGaps::position, {-1.2, -2.6, -2.9}, "rad, HAA HFE KFE"},
          {"position_max", &LimitGaps::position, {1.2, 2.6, 2.9}, "rad, HAA HFE KFE"}};
}

/// Which joints lack a limit.
class Lacking {
 public:
  Lacking(const Diagnosis& robot, bool LimitGaps::* gap) {
    lacks_.resize(static_cast<int>(robot.anatomy.legs->size()));
    for (const Leg leg : lacks_.legs()) {
      for (std::size_t j = 0; j < kJointsPerLeg; ++j) {
        const model::UrdfJoint& joint = (*robot.anatomy.legs)[index(leg)].joints[j];
        lacks_[index(leg)][j] = gaps_of(robot, joint).*gap;
      }
    }
  }
  [[nodiscard]] bool all() const {
    return std::ranges::all_of(lacks_, [](const auto& leg) {
      return std::ranges::all_of(leg, [](bool lacks) { return lacks; });
    });
  }
  [[nodiscard]] const std::array<bool, kJointsPerLeg>& of(Leg leg) const {
    return lacks_[index(leg)];
  }

 private:
  PerLeg<std::array<bool, kJointsPerLeg>> lacks_{};
};

const char* to_fill_in(Guesses guesses) {
  return guesses == Guesses::as_comments
             ? "   # fill in, and take the # away: the file has placeholders or nothing; these are "
               "ANYmal B's, to size"
             : "";
}

/// What all joints of all legs lack.
std::string limit_lines(const Diagnosis& robot, Guesses guesses) {
  const std::string begin = guesses == Guesses::as_comments ? "#" : "";
  std::string text;
  for (const Guess& guess : guesses_for(robot)) {
    if (!Lacking(robot, guess.gap).all()) continue;
    const auto& [haa, hfe, kfe] = guess.numbers;
    const bool is_one = haa == hfe && hfe == kfe;
    text += begin + "  " + guess.key + ": " +
            (is_one ? formatted("%.3g", haa) : formatted("[%.4g, %.4g, %.4g]", haa, hfe, kfe)) +
            "   # " + guess.help + "\n";
  }
  return text.empty() ? "" : begin + "limits:" + to_fill_in(guesses) + "\n" + text;
}

/// What only some joints lack, of one leg: joints that have limits keep them.
std::string limit_lines_of(Leg leg, const Diagnosis& robot, Guesses guesses) {
  const std::string begin = guesses == Guesses::as_comments ? "#   " : "    ";
  std::string text;
  for (const Guess& guess : guesses_for(robot)) {
    const Lacking lacking(robot, guess.gap);
    if (lacking.all()) continue;
    std::string numbers;
    for (std::size_t j = 0; j < kJointsPerLeg; ++j) {
      if (!lacking.of(leg)[j]) continue;
      numbers += (numbers.empty() ? "" : ", ") + std::string(kJointNames[j]) +
                 formatted(": %.3g", guess.numbers[j]);
    }
    if (!numbers.empty())
      text += begin + "  " + guess.key + ": {" + numbers + "}   # " + guess.help + "\n";
  }
  return text.empty() ? "" : begin + "limits:" + to_fill_in(guesses) + "\n" + text;
}

std::string listed(const std::vector<double>& numbers) {
  std::string text;
  for (const double number : numbers)
    text += (text.empty() ? "[" : ", ") + formatted("%.4g", number);
  return text + "]";
}

std::string flat_leg_lines(const FlatLegs& found) {
  std::string text = "legs:   # postures are guesses: knees bent, soles level; rad\n";
  for (const Leg leg : first_legs(2)) {
    const FlatLeg& flat = found.legs[index(leg)];
    text += "  " + std::string(leg_name(leg, 2)) + ": {foot: " + quoted(flat.foot) +
            ", posture: " + listed(flat.posture) + "}\n";
  }
  return text;
}

std::string sole_lines(const Sole& sole) {
  return formatted(
             "foot:   # m; the sole, by %s: measure it\n",
             sole.is_guess ? "the leg's length alone" : "what lies lowest on the foot's link") +
         formatted("  size: [%.4g, %.4g]\n  center: [%.4g, %.4g, %.4g]\n", sole.size.x(),
                   sole.size.y(), sole.center.x(), sole.center.y(), sole.center.z());
}

/// A limit of an arm's joints where one lacks it: the known ones, and guesses.
struct ArmLimit {
  const char* key;
  double model::UrdfJoint::* described;
  double guess;
  const char* unit;
};

std::string arm_limit_lines(const Diagnosis& robot, const Limb& limb, Guesses guesses) {
  const Scale scale = robot.proportions ? model::scale_of(*robot.proportions) : Scale();
  std::string text;
  for (const ArmLimit& limit :
       {ArmLimit{"torque", &model::UrdfJoint::effort, 40.0 * scale.torque(), "N·m"},
        ArmLimit{"velocity", &model::UrdfJoint::velocity, 6.0 * scale.rate(), "rad/s"},
        ArmLimit{"position_min", &model::UrdfJoint::lower, -kPi, "rad"},
        ArmLimit{"position_max", &model::UrdfJoint::upper, kPi, "rad"}}) {
    std::vector<double> numbers;
    bool lacks = false;
    const bool is_positive = limit.guess > 0.0 && std::string(limit.unit) != "rad";
    for (const model::UrdfJoint& joint : limb.joints) {
      const double given = joint.*limit.described;
      const bool is_missing = std::isnan(given) || (is_positive && given <= 0.0);
      lacks |= is_missing;
      numbers.push_back(is_missing ? limit.guess : given);
    }
    if (!lacks) continue;
    text += std::string(guesses == Guesses::as_comments ? "#   " : "    ") + limit.key + ": " +
            listed(numbers) + "   # " + limit.unit +
            (guesses == Guesses::as_comments ? "; guesses: fill in, and take the # away" : "") +
            "\n";
  }
  return text;
}

std::string arm_lines(const Diagnosis& robot, Guesses guesses) {
  std::string text;
  for (const Limb& limb : robot.anatomy.others) {
    if (!limb.is_arm) continue;
    text += (text.empty() ? std::string("arms:\n") : "") +
            "  - name: " + quoted(limb.joints.front().name) +
            "\n    tip: " + quoted(limb.joints.back().child) + "\n" +
            arm_limit_lines(robot, limb, guesses);
  }
  return text;
}

/// The link alone on one line; what this leg has by itself, below it.
std::string leg_lines(const Diagnosis& robot, Guesses guesses) {
  const PerLeg<FoundLeg>& legs = *robot.anatomy.legs;
  std::string text = "legs:\n";
  for (const Leg leg : legs.legs()) {
    const Foot& foot = legs[index(leg)].foot;
    const std::string own = limit_lines_of(leg, robot, guesses);
    text += "  " + std::string(leg_name(leg, static_cast<int>(legs.size()))) + ":" +
            (own.empty() ? " {foot: " + quoted(foot.link) + "}\n"
                         : "\n    foot: " + quoted(foot.link) + "\n" + own);
  }
  return text;
}

}  // namespace

std::string robot_file_text(const Diagnosis& robot, const std::filesystem::path& folder,
                            Guesses guesses) {
  if (!has_legs(robot.anatomy)) {
    throw Error(robot.urdf.path +
                ": its legs were not found, so there is no robot file; the findings say why");
  }
  return std::string("# Written by `surefoot doctor`. What is not here follows from the ") +
         robot.urdf.format() + ": joints, limits, size.\nname: " + quoted(robot.name) +
         (robot.urdf.text.empty() ? "\nurdf: " : "\nmjcf: ") +
         quoted(urdf_seen_from(robot, folder)) + "\n" +
         (robot.anatomy.legs ? leg_lines(robot, guesses)
                             : flat_leg_lines(*robot.anatomy.flat_legs)) +
         arm_lines(robot, guesses) +
         (robot.anatomy.legs
              ? foot_lines(foot_of_all(*robot.anatomy.legs), guesses) + limit_lines(robot, guesses)
              : sole_lines(robot.anatomy.flat_legs->sole));
}

void write_robot_file(const Diagnosis& robot, const std::filesystem::path& file) {
  const std::string extension = file.extension().string();
  if (extension != ".yaml" && extension != ".yml")
    throw Error(file.string() + ": a robot file's name ends in .yaml");
  if (std::filesystem::exists(std::filesystem::symlink_status(file)))
    throw Error(file.string() + ": exists already and is not written over; give another name");
  const std::filesystem::path folder = std::filesystem::absolute(file).parent_path();
  logging::write_file(file, robot_file_text(robot, folder, Guesses::as_comments));
}

}  // namespace surefoot::doctor
