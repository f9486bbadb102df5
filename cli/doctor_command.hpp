#pragma once

#include <string>

namespace surefoot::cli {

/// `surefoot doctor`, as typed.
struct DoctorArguments {
  std::string urdf;
  std::string out;   ///< robot file to write; empty: none
  std::string name;  ///< of the robot; empty: the URDF's
  bool walk = false;
  bool json = false;
};

/// Examines a URDF, prints what it finds and writes the robot file. Returns an ExitCode: 2 with
/// errors, 1 if a trial walk does not succeed. Throws Error if the URDF can't be read or the file
/// can't be written.
int doctor_command(const DoctorArguments& arguments);

}  // namespace surefoot::cli
