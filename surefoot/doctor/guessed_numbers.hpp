#pragma once

#include "surefoot/doctor/diagnosis.hpp"
#include "surefoot/doctor/robot_file_text.hpp"

#include <string>
#include <vector>

namespace surefoot::doctor {

/// The numbers of the robot's file that are guesses, and not comments, with their keys: limits that
/// the description lacks, a foot's radius without a sphere, a sole without a shape.
[[nodiscard]] std::vector<std::string> guessed_numbers(const Diagnosis& robot, Guesses guesses);

}  // namespace surefoot::doctor
