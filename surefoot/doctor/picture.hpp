#pragma once

#include "surefoot/doctor/diagnosis.hpp"

#include <filesystem>
#include <string>

namespace surefoot::doctor {

/// The robot as SVG, seen from the right, from the left and from above: lines between joints, their
/// axes and names, feet, centre of mass. Without legs all limbs that were found.
[[nodiscard]] std::string picture(const Diagnosis& robot);

/// Writes it beside a robot file, as NAME.svg, over an earlier one. Returns its path. Throws
/// FileError if it can't be written.
std::filesystem::path write_picture(const Diagnosis& robot,
                                    const std::filesystem::path& robot_file);

}  // namespace surefoot::doctor
