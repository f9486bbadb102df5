#include "surefoot/doctor/robot_file_text.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/base/formatted.hpp"
#include "surefoot/doctor/checks.hpp"
#include "surefoot/logging/output_files.hpp"

#include <algorithm>
#include <array>

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

std::string leg_lines(const PerLeg<FoundLeg>& legs) {
  std::string text = "legs:\n";
  for (const Leg leg : kLegs) {
    text += "  " + std::string(kLegNames[index(leg)]) +
            ": {foot: " + quoted(legs[index(leg)].foot.link) + "}\n";
  }
  return text;
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

/// Position limits of HAA, HFE, KFE: the URDF's widest where it has them, else a guess [rad].
std::array<Vec3, 2> position_limits(const PerLeg<FoundLeg>& legs) {
  std::array<Vec3, 2> limits{Vec3(-1.2, -2.6, -2.9), Vec3(1.2, 2.6, 2.9)};
  for (std::size_t j = 0; j < kJointsPerLeg; ++j) {
    double lower = kInfinity, upper = -kInfinity;
    bool is_whole = true;
    for (const FoundLeg& leg : legs) {
      is_whole = is_whole && has_position_limits(leg.joints[j]);
      lower = std::min(lower, leg.joints[j].lower);
      upper = std::max(upper, leg.joints[j].upper);
    }
    if (!is_whole) continue;
    limits[0][static_cast<Eigen::Index>(j)] = lower;
    limits[1][static_cast<Eigen::Index>(j)] = upper;
  }
  return limits;
}

/// Limits that the URDF lacks, as ANYmal B's are for a robot of this size.
std::string limit_lines(const Diagnosis& robot, Guesses guesses) {
  const LimitGaps gaps = limit_gaps(robot);
  if (!gaps.effort && !gaps.velocity && !gaps.position) return "";
  const Scale scale = robot.proportions ? model::scale_of(*robot.proportions) : Scale();
  const bool is_comment = guesses == Guesses::as_comments;
  const std::string begin = is_comment ? "#" : "";
  std::string text = begin + "limits:" +
                     (is_comment ? "                      # fill in, and take the # away: the file "
                                   "has placeholders or nothing; these are ANYmal B's, to size"
                                 : "") +
                     "\n";
  if (gaps.effort) {
    text += begin + formatted("  torque: %.3g", 40.0 * scale.torque()) +
            "            # N·m, of the drives\n";
  }
  if (gaps.velocity) {
    text += begin + formatted("  velocity: %.3g", 15.0 * scale.rate()) +
            "           # rad/s, where no torque is left\n";
  }
  if (gaps.position) {
    const auto [lower, upper] = position_limits(*robot.anatomy.legs);
    text += begin + formatted("  position_min: [%.4g, %.4g, %.4g]   # rad, HAA HFE KFE\n",
                              lower.x(), lower.y(), lower.z());
    text +=
        begin + formatted("  position_max: [%.4g, %.4g, %.4g]\n", upper.x(), upper.y(), upper.z());
  }
  return text;
}

}  // namespace

std::string robot_file_text(const Diagnosis& robot, const std::filesystem::path& folder,
                            Guesses guesses) {
  if (!robot.anatomy.legs) {
    throw Error(robot.urdf.path +
                ": four legs were not found, so there is no robot file; the findings say why");
  }
  return std::string("# Written by `surefoot doctor`. What is not here follows from the ") +
         robot.urdf.format() + ": joints, limits, size.\nname: " + quoted(robot.name) +
         (robot.urdf.text.empty() ? "\nurdf: " : "\nmjcf: ") +
         quoted(urdf_seen_from(robot, folder)) + "\n" + leg_lines(*robot.anatomy.legs) +
         foot_lines(robot.anatomy.legs->front().foot, guesses) + limit_lines(robot, guesses);
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
