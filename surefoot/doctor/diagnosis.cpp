#include "surefoot/doctor/diagnosis.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/config/description_file.hpp"
#include "surefoot/config/robot_file.hpp"
#include "surefoot/control/standing_torque.hpp"
#include "surefoot/doctor/checks.hpp"
#include "surefoot/doctor/guessed_file.hpp"
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
    robot.findings.push_back({Severity::error, Confidence::certain, "robot file", 0,
                              "the program refuses the robot: " + what, ""});
  }
}

}  // namespace

bool is_robot_name(const std::string& name) {
  return !name.empty() && std::ranges::all_of(name, is_of_name) && name.front() != '_' &&
         name.front() != '-' && name.front() != '.';
}

Diagnosis examine(const std::string& urdf, const std::string& name) {
  Diagnosis robot;
  robot.given = urdf;
  const config::DescriptionFile file = config::read_description(urdf);
  robot.urdf = model::read_urdf(file.path, model::ImpossibleInertia::kept, file.urdf);
  robot.name = name.empty() ? name_of(robot.urdf.path) : name;
  robot.anatomy = find_anatomy(robot.urdf, robot.findings);
  check_size(robot);
  check_axes(robot);
  check_flat_feet(robot);
  if (!has_cause(robot.findings)) check_feet(robot);
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
  sort_worst_first(robot.findings);
  return robot;
}

}  // namespace surefoot::doctor
