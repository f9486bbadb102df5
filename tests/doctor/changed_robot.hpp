#pragma once

#include "surefoot/config/data_file.hpp"
#include "surefoot/config/robot_file.hpp"
#include "surefoot/doctor/diagnosis.hpp"
#include "tests/logging/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <string>

namespace surefoot::test {

/// The URDF of a robot that ships, in a folder of its own, to be changed and examined.
class ChangedRobot : public testing::Test {
 protected:
  explicit ChangedRobot(const std::string& robot = "anymal_b")
      : urdf_(contents(config::load_robot(robot).urdf_path)) {}

  /// Changes the first place of a text behind another.
  void change(const std::string& behind, const std::string& from, const std::string& to) {
    const std::size_t begin = urdf_.find(behind);
    ASSERT_NE(begin, std::string::npos) << behind;
    const std::size_t place = urdf_.find(from, begin);
    ASSERT_NE(place, std::string::npos) << from;
    urdf_.replace(place, from.size(), to);
  }

  void replace_all(const std::string& pattern, const std::string& by) {
    urdf_ = std::regex_replace(urdf_, std::regex(pattern), by);
  }

  doctor::Diagnosis diagnosis() {
    write_file(folder_ / "robot.urdf", urdf_);
    return doctor::examine(folder_ / "robot.urdf");
  }

  TemporaryFolder folder_;
  std::string urdf_;
};

/// The first finding with these words and this severity, or an empty one.
inline doctor::Finding finding(const doctor::Diagnosis& robot, doctor::Severity severity,
                               const std::string& words) {
  const auto found = std::ranges::find_if(robot.findings, [&](const doctor::Finding& each) {
    const std::string text = each.subject + ": " + each.what + " " + each.remedy;
    return each.severity == severity && text.find(words) != std::string::npos;
  });
  return found == robot.findings.end() ? doctor::Finding() : *found;
}

inline testing::AssertionResult has(const doctor::Diagnosis& robot, doctor::Severity severity,
                                    const std::string& words) {
  if (!finding(robot, severity, words).what.empty()) return testing::AssertionSuccess();
  testing::AssertionResult failure = testing::AssertionFailure();
  failure << "no " << name(severity) << " has \"" << words << "\"; there are:";
  for (const doctor::Finding& each : robot.findings)
    failure << "\n" << name(each.severity) << ": " << each.subject << ": " << each.what;
  return failure;
}

}  // namespace surefoot::test
