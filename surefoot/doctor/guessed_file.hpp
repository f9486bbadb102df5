#pragma once

#include "surefoot/doctor/diagnosis.hpp"
#include "surefoot/logging/scratch_folder.hpp"

#include <string>

namespace surefoot::doctor {

/// A robot's file for the program to read now: the one it has, or one with guesses for what its
/// description lacks, which goes with the object.
class GuessedFile {
 public:
  explicit GuessedFile(const Diagnosis& robot);

  [[nodiscard]] const std::string& path() const { return path_; }
  /// A message of the program, "robot file" for the path that nobody will find.
  [[nodiscard]] std::string without_path(std::string message) const;

 private:
  logging::ScratchFolder folder_;
  bool is_guess_;
  std::string path_;
};

}  // namespace surefoot::doctor
