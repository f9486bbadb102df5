#include "surefoot/doctor/diagnosis.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/config/data_file.hpp"
#include "surefoot/config/description_file.hpp"
#include "surefoot/config/robot_file.hpp"
#include "surefoot/control/standing_torque.hpp"
#include "surefoot/doctor/checks.hpp"
#include "surefoot/doctor/guessed_file.hpp"
#include "surefoot/doctor/mjcf_words.hpp"
#include "surefoot/doctor/robot_file_text.hpp"
#include "surefoot/logging/scratch_folder.hpp"
#include "surefoot/model/robot_model.hpp"

#include <algorithm>
#include <filesystem>

namespace surefoot::doctor {
namespace {

bool is_of_name(char letter) {
  return (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z') ||
         (letter >= '0' && letter <= '9') || letter == '_' || letter == '-' || letter == '.';
}

std::string name_of(const std::string& urdf) {
  std::string name = std::filesystem::path(urdf).stem().string();
  std::ranges::replace_if(name, [](char letter) { return !is_of_name(letter); }, '_');
  return is_robot_name(name) ? name : "robot" + name;
}

/// The robot file that is meant, by its path or the name of a robot that ships; empty: none.
std::string robot_file_called(const std::string& given) {
  const std::filesystem::path path = given;
  if (path.extension() == ".yaml" || path.extension() == ".yml") return given;
  const std::vector<std::string> ours = config::list_data("robots");
  const bool is_ours =
      !std::filesystem::is_regular_file(path) && std::ranges::count(ours, given) > 0;
  return is_ours ? config::find_data_file("robots", given).string() : "";
}

/// The limits of a robot's file in place of its description's.
void take_limits(const model::RobotDescription& file, model::UrdfJoint& joint) {
  const std::vector<std::string> names = file.joint_names();
  const auto found = std::ranges::find(names, joint.name);
  if (found == names.end()) return;
  const auto i = static_cast<Eigen::Index>(found - names.begin());
  joint.effort = file.torque_limit[i];
  joint.velocity = file.velocity_limit[i];
  joint.lower = file.q_min[i];
  joint.upper = file.q_max[i];
}

void take_numbers(const model::RobotDescription& file, Anatomy& anatomy) {
  for (Limb& limb : anatomy.others) {
    for (model::UrdfJoint& joint : limb.joints) take_limits(file, joint);
  }
  if (!anatomy.legs) return;
  for (FoundLeg& leg : *anatomy.legs) {
    for (model::UrdfJoint& joint : leg.joints) take_limits(file, joint);
    for (model::UrdfJoint& joint : leg.all_joints) take_limits(file, joint);
    leg.foot.guessed_from.clear();
  }
}

/// Is this line of the URDF among the errors already?
bool is_told(const Findings& findings, const std::string& message) {
  return std::ranges::any_of(findings, [&](const Finding& finding) {
    const std::string line = ":" + std::to_string(finding.line);
    return finding.severity == Severity::error && finding.line > 0 &&
           (message.find(line + ":") != std::string::npos ||
            message.find(line + ")") != std::string::npos);
  });
}

/// Lets the program read the robot file; what it refuses is an error unless a check told it.
void load(Diagnosis& robot) {
  if (!has_legs(robot.anatomy) || robot.anatomy.base != robot.anatomy.root) return;
  const GuessedFile file(robot);
  try {
    robot.robot = config::load_robot(file.path());
    model::RobotModel model(*robot.robot);
    robot.standing_torque = control::standing_torque(model, robot.robot->q_nominal);
    robot.proportions = model::proportions_of(model);
  } catch (const Error& error) {
    robot.robot.reset();
    const std::string what = file.without_path(error.what());
    if (is_told(robot.findings, what)) return;
    robot.findings.push_back({Severity::error, of_refusal(robot.findings), "robot file", 0,
                              "the program refuses the robot: " + what, ""});
  }
}

}  // namespace

bool is_robot_name(const std::string& name) {
  return !name.empty() && std::ranges::all_of(name, is_of_name) && name.front() != '_' &&
         name.front() != '-' && name.front() != '.';
}

Diagnosis examine(const std::string& given, const std::string& name) {
  Diagnosis robot;
  robot.given = given;
  robot.robot_file = robot_file_called(given);
  const bool has_file = !robot.robot_file.empty();
  const auto of_file = has_file ? config::load_robot(robot.robot_file) : model::RobotDescription();
  const config::DescriptionFile file =
      has_file ? config::DescriptionFile{of_file.urdf_path, of_file.urdf_text}
               : config::read_description(given);
  robot.urdf = model::read_urdf(file.path, model::ImpossibleInertia::kept, file.urdf);
  robot.name = !name.empty() ? name : has_file ? of_file.name : name_of(robot.urdf.path);
  robot.anatomy = find_anatomy(robot.urdf, robot.findings, of_file.arms);
  if (has_file) take_numbers(of_file, robot.anatomy);
  check_joints(robot);
  if (!has_cause(robot.findings)) check_size(robot);
  if (!has_cause(robot.findings)) check_axes(robot);
  check_flat_feet(robot);
  if (!has_cause(robot.findings)) check_feet(robot);
  if (!has_cause(robot.findings)) check_shapes(robot);
  check_inertias(robot);
  check_names(robot);
  if (!has_cause(robot.findings)) check_signs(robot);
  if (!has_cause(robot.findings)) {
    load(robot);
    check_symmetry(robot);
  }
  check_limits(robot);
  check_stance(robot);
  check_agreement(robot);
  if (!robot.urdf.text.empty()) say_as_mjcf(robot.findings);
  sort_worst_first(robot.findings);
  return robot;
}

}  // namespace surefoot::doctor
