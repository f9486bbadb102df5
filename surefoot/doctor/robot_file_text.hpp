#pragma once

#include "surefoot/doctor/diagnosis.hpp"

#include <filesystem>
#include <string>

namespace surefoot::doctor {

/// Whether numbers that the URDF lacks stand in the robot file as comments, to be filled in, or as
/// the guesses that they are.
enum class Guesses { as_comments, as_numbers };

/// The robot file of a robot whose legs were found. `folder`: where it will lie; its `urdf:` is the
/// path seen from there, or the package:// name that was given.
[[nodiscard]] std::string robot_file_text(const Diagnosis& robot,
                                          const std::filesystem::path& folder, Guesses guesses);

/// Writes that file whole, with guesses as comments. Throws Error if there is one already, also the
/// one that was examined, if its name does not end in .yaml or .yml, if the robot's legs were not
/// found, or if it can't be written.
void write_robot_file(const Diagnosis& robot, const std::filesystem::path& file);

}  // namespace surefoot::doctor
