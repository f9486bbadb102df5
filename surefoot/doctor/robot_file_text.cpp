#include "surefoot/doctor/robot_file_text.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/base/formatted.hpp"
#include "surefoot/doctor/guessed_numbers.hpp"
#include "surefoot/doctor/limit_guesses.hpp"
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

/// A line of the robot file, or what would be one.
struct Line {
  std::string text;
  bool is_comment = false;  ///< a guess, to be filled in
};

/// `limits:` and what belongs to it; a key with nothing but comments would be a fault.
std::string limits_block(const std::string& indent, const std::vector<Line>& lines) {
  if (lines.empty()) return "";
  const bool is_empty = std::ranges::all_of(lines, &Line::is_comment);
  const auto mark = [](bool is_comment) { return std::string(is_comment ? "#" : ""); };
  std::string text = mark(is_empty) + indent + "limits:\n";
  for (const Line& line : lines) {
    text += mark(line.is_comment) + indent + "  " + line.text +
            (line.is_comment ? "; fill in, and take the # away: ANYmal B's, to size" : "") + "\n";
  }
  return text;
}

/// A key of the limits that some joint of a leg lacks.
class Lacking {
 public:
  Lacking(const Diagnosis& robot, const LimitGuess& guess) : guess_(guess) {
    const bool is_position = guess.gap == &LimitGaps::position;
    lacks_.resize(static_cast<int>(robot.anatomy.legs->size()));
    for (const Leg leg : lacks_.legs()) {
      for (std::size_t j = 0; j < kJointsPerLeg; ++j) {
        const LimitGaps gaps = gaps_of(robot, (*robot.anatomy.legs)[index(leg)].joints[j]);
        const bool is_free = is_position && gaps.turns;
        lacks_[index(leg)][j] = gaps.*(guess.gap) || is_free;
        is_unknown_ |= gaps.*(guess.gap);
      }
    }
  }
  [[nodiscard]] bool all() const {
    return std::ranges::all_of(lacks_, [](const auto& leg) {
      return std::ranges::all_of(leg, [](bool lacks) { return lacks; });
    });
  }
  [[nodiscard]] Line line(const std::string& numbers, Guesses guesses) const {
    return {guess_.key + (": " + numbers) + "   # " + guess_.unit +
                (is_unknown_ ? ""
                             : "; its joints have no stops: narrow it where something is in "
                               "the way"),
            is_unknown_ && guesses == Guesses::as_comments};
  }
  /// Of all joints of all legs.
  [[nodiscard]] std::string numbers() const {
    const auto& [haa, hfe, kfe] = guess_.numbers;
    const bool is_one = haa == hfe && hfe == kfe;
    return is_one ? formatted("%.3g", haa) : formatted("[%.4g, %.4g, %.4g]", haa, hfe, kfe);
  }
  /// Of those joints of one leg that lack it.
  [[nodiscard]] std::string numbers_of(Leg leg) const {
    std::string text;
    for (std::size_t j = 0; j < kJointsPerLeg; ++j) {
      if (!lacks_[index(leg)][j]) continue;
      text += (text.empty() ? "{" : ", ") + std::string(kJointNames[j]) +
              formatted(": %.3g", guess_.numbers[j]);
    }
    return text.empty() ? "" : text + "}";
  }

 private:
  const LimitGuess guess_;
  PerLeg<std::array<bool, kJointsPerLeg>> lacks_{};
  bool is_unknown_ = false;
};

/// What all joints of all legs lack.
std::string limit_lines(const Diagnosis& robot, Guesses guesses) {
  std::vector<Line> lines;
  for (const LimitGuess& guess : limit_guesses(robot)) {
    const Lacking lacking(robot, guess);
    if (lacking.all()) lines.push_back(lacking.line(lacking.numbers(), guesses));
  }
  return limits_block("", lines);
}

/// What only some joints lack, of one leg: joints that have limits keep them.
std::string limit_lines_of(Leg leg, const Diagnosis& robot, Guesses guesses) {
  std::vector<Line> lines;
  for (const LimitGuess& guess : limit_guesses(robot)) {
    const Lacking lacking(robot, guess);
    const std::string numbers = lacking.numbers_of(leg);
    if (!lacking.all() && !numbers.empty()) lines.push_back(lacking.line(numbers, guesses));
  }
  return limits_block("    ", lines);
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
std::string arm_limit_lines(const Diagnosis& robot, const Limb& limb, Guesses guesses) {
  std::string text;
  for (const LimitGuess& guess : limit_guesses(robot)) {
    const bool is_position = guess.gap == &LimitGaps::position;
    std::vector<double> numbers;
    bool lacks = false, is_unknown = false;
    for (const model::UrdfJoint& joint : limb.joints) {
      const double given = joint.*guess.given;
      const bool is_guess = is_position ? std::isnan(given) : is_missing(given);
      lacks |= is_guess;
      is_unknown |= is_guess && !(is_position && gaps_of(robot, joint).turns);
      numbers.push_back(is_guess ? guess.of_arm : given);
    }
    if (!lacks) continue;
    const bool is_comment = is_unknown && guesses == Guesses::as_comments;
    text += std::string(is_comment ? "#    " : "    ") + guess.key + ": " + listed(numbers) +
            "   # " + guess.unit + (is_comment ? "; guesses: fill in, and take the # away" : "") +
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

/// A sphere that is not as that of all.
std::string foot_lines_of(const Foot& foot, const Foot& of_all) {
  if (!foot.guessed_from.empty() || is_same_sphere(foot, of_all)) return "";
  return formatted("    foot_radius: %.6g   # m\n    foot_center: [%.6g, %.6g, %.6g]\n",
                   foot.radius, foot.center.x(), foot.center.y(), foot.center.z());
}

/// The link alone on one line; what this leg has by itself, below it.
std::string leg_lines(const Diagnosis& robot, Guesses guesses) {
  const PerLeg<FoundLeg>& legs = *robot.anatomy.legs;
  std::string text = "legs:\n";
  for (const Leg leg : legs.legs()) {
    const Foot& foot = legs[index(leg)].foot;
    const std::string own =
        foot_lines_of(foot, foot_of_all(legs)) + limit_lines_of(leg, robot, guesses);
    text += "  " + std::string(leg_name(leg, static_cast<int>(legs.size()))) + ":" +
            (own.empty() ? " {foot: " + quoted(foot.link) + "}\n"
                         : "\n    foot: " + quoted(foot.link) + "\n" + own);
  }
  return text;
}

/// Every run tells them until the line is taken out.
std::string guess_lines(const Diagnosis& robot, Guesses guesses) {
  const std::vector<std::string> numbers = guessed_numbers(robot, guesses);
  std::string text;
  for (const std::string& number : numbers)
    text += (text.empty() ? "guessed:   # runs tell it; take out what is measured\n" : "") +
            ("  - " + quoted(number) + "\n");
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
              : sole_lines(robot.anatomy.flat_legs->sole)) +
         guess_lines(robot, guesses);
}

void write_robot_file(const Diagnosis& robot, const std::filesystem::path& file) {
  if (!robot.robot_file.empty())
    throw Error(robot.name + " has a robot file, " + robot.robot_file +
                "; give its URDF or MJCF to write another: " + robot.urdf.path);
  const std::string extension = file.extension().string();
  if (extension != ".yaml" && extension != ".yml")
    throw Error(file.string() + ": a robot file's name ends in .yaml");
  if (std::filesystem::exists(std::filesystem::symlink_status(file)))
    throw Error(file.string() + ": exists already and is not written over; give another name");
  const std::filesystem::path folder = std::filesystem::absolute(file).parent_path();
  logging::write_file(file, robot_file_text(robot, folder, Guesses::as_comments));
}

}  // namespace surefoot::doctor
