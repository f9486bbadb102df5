#include "surefoot/base/formatted.hpp"
#include "surefoot/base/text_table.hpp"
#include "surefoot/doctor/knees.hpp"
#include "surefoot/doctor/limit_guesses.hpp"
#include "surefoot/doctor/report.hpp"

#include <algorithm>

namespace surefoot::doctor {
namespace {

std::string joints_text(const std::vector<model::UrdfJoint>& joints) {
  std::string names;
  for (const model::UrdfJoint& joint : joints) names += (names.empty() ? "" : " ") + joint.name;
  return names;
}

/// "LF_HAA LF_HFE LF_KFE, held: LF_YAW"
std::string joints_text(const FoundLeg& leg) {
  const std::vector<model::UrdfJoint> held = leg.further();
  return joints_text({leg.joints.begin(), leg.joints.end()}) +
         (held.empty() ? "" : ", held: " + joints_text(held));
}

std::string base_text(const Diagnosis& robot) {
  const Anatomy& anatomy = robot.anatomy;
  const auto num_moving = std::ranges::count_if(
      robot.urdf.joints, [](const model::UrdfJoint& joint) { return joint.type != "fixed"; });
  std::string text = robot.name + ": " + robot.urdf.path + ", " +
                     std::to_string(robot.urdf.links.size()) + " links, " +
                     std::to_string(num_moving) + " joints that move\n";
  if (!robot.robot_file.empty()) text += "limits, feet and postures: " + robot.robot_file + "\n";
  text += "base: " + anatomy.base;
  if (anatomy.base == anatomy.root) text += ", the root";
  if (anatomy.torso != anatomy.base)
    text += "; \"" + anatomy.torso + "\", fixed to it, is heaviest";
  return text + "\n";
}

std::string foot_text(const Foot& foot) {
  return foot.link +
         formatted(", %s%.4g m", foot.guessed_from.empty() ? "" : "guessed ", foot.radius);
}

std::string legs_table(const PerLeg<FoundLeg>& legs) {
  std::vector<std::vector<std::string>> rows{
      {"leg", "hip x, y", "thigh", "shank", "knee bends", "foot, radius", "joints"}};
  for (const Leg leg : legs.legs()) {
    const FoundLeg& found = legs[index(leg)];
    rows.push_back({std::string(leg_name(leg, static_cast<int>(legs.size()))),
                    formatted("%.3f, %.3f m", found.hip.x(), found.hip.y()),
                    formatted("%.3f m", found.thigh), formatted("%.3f m", found.shank),
                    name(knee_sides(found)), foot_text(found.foot), joints_text(found)});
  }
  return aligned(rows);
}

std::string flat_legs_table(const FlatLegs& found) {
  std::vector<std::vector<std::string>> rows{{"leg", "length", "foot, sole", "joints"}};
  for (const Leg leg : first_legs(2)) {
    const FlatLeg& flat = found.legs[index(leg)];
    rows.push_back(
        {std::string(leg_name(leg, 2)), formatted("%.3f m", found.length),
         flat.foot + formatted(", %s%.3g x %.3g m", found.sole.is_guess ? "guessed " : "",
                               found.sole.size.x(), found.sole.size.y()),
         joints_text(flat.joints)});
  }
  return aligned(rows);
}

std::string limbs_text(const Anatomy& anatomy) {
  std::string text;
  for (const FoundLeg& leg : anatomy.loose) {
    text += "limb like a leg: " + joints_text(leg) +
            formatted(", hip at x = %.3g, y = %.3g m, foot ", leg.hip.x(), leg.hip.y()) +
            leg.foot.link + "\n";
  }
  for (const Limb& limb : anatomy.others) {
    text += limb.is_arm
                ? "arm or waist: " + joints_text(limb.joints) + "\n"
                : "other limb: " + joints_text(limb.joints) + "; no leg: " + limb.no_leg + "\n";
  }
  return text;
}

std::string reach_text(const Diagnosis& robot) {
  if (!robot.reach) return "";
  return formatted(
      "reach %.3f m below the hip; the stance uses %.0f %% of it, with feet at least %.3f m from "
      "the axes of HAA\n",
      robot.reach->longest, 100.0 * robot.reach->stretched,
      robot.reach->from_haa * robot.reach->longest);
}

std::string proportions_text(const Diagnosis& robot) {
  if (!robot.proportions || !robot.anatomy.legs) return "";
  const model::Proportions& found = *robot.proportions;
  const Scale scale = model::scale_of(found);
  return formatted(
             "leg %.3f m, mass %.2f kg; against ANYmal B: %.2f of the leg, %.2f of the mass\n",
             found.leg, found.mass, scale.length, scale.mass) +
         formatted("to stand: at most %.3g N·m at a joint\n",
                   robot.standing_torque.cwiseAbs().maxCoeff()) +
         reach_text(robot);
}

std::string finding_text(const Finding& finding, const std::string& file) {
  std::string text = std::string(name(finding.severity)) + " (" + name(finding.confidence) +
                     "): " + finding.subject;
  if (finding.line > 0) text += " (" + file + ":" + std::to_string(finding.line) + ")";
  text += ": " + finding.what;
  return text + (finding.remedy.empty() ? "" : "\n  → " + finding.remedy) + "\n";
}

std::string count_text(const Findings& findings) {
  std::string text;
  for (const Severity severity : {Severity::error, Severity::warning, Severity::note}) {
    const auto count = std::ranges::count(findings, severity, &Finding::severity);
    text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + name(severity) +
            (count == 1 ? "" : "s");
  }
  return text;
}

std::string trials_text(const Diagnosis& robot, const std::vector<Trial>& trials) {
  if (trials.empty()) return "";
  std::string text = "\n";
  if (robot.robot_file.empty() && has_gaps(robot))
    text += "walked with guessed limits, which the robot file has as comments:\n";
  for (const Trial& trial : trials) {
    text += trial.scenario + (trial.succeeded ? ": succeeded: " : ": did not succeed: ") +
            trial.why + "\n";
    if (trial.succeeded) continue;
    text += trial.log.empty()
                ? "  → surefoot run " + trial.base + " --set robot=FILE --view shows it\n"
                : "  → surefoot report " + trial.log + " shows it\n";
  }
  return text;
}

}  // namespace

std::string report_text(const Diagnosis& robot, const std::vector<Trial>& trials) {
  std::string text = base_text(robot);
  if (robot.anatomy.legs && robot.anatomy.legs->size() == kMaxLegs)
    text += "six legs, in three pairs from the front to the hind one\n";
  if (robot.anatomy.legs) text += "\n" + legs_table(*robot.anatomy.legs);
  if (robot.anatomy.flat_legs) text += "\n" + flat_legs_table(*robot.anatomy.flat_legs);
  text += limbs_text(robot.anatomy) + proportions_text(robot);
  text += "\n" + count_text(robot.findings) + "\n";
  if (has_cause(robot.findings))
    text += "mend the first: others may follow from it, and more is checked then\n";
  const std::size_t slash = robot.urdf.path.find_last_of('/') + 1;
  for (const Finding& finding : robot.findings)
    text += finding_text(finding, robot.urdf.path.substr(slash));
  return text + trials_text(robot, trials);
}

}  // namespace surefoot::doctor
