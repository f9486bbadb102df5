#pragma once

#include "surefoot/doctor/guessed_file.hpp"
#include "surefoot/model/frames.hpp"
#include "surefoot/model/robot_model.hpp"

#include <memory>
#include <optional>
#include <string>

namespace surefoot::python {

/// `Robot` in Python: a description, with its model and frames.
class Robot {
 public:
  /// By the name or path of a robot file, or from a URDF or MJCF, with guesses for what it lacks.
  explicit Robot(const std::string& name_or_path);
  explicit Robot(const doctor::Diagnosis& diagnosis);
  explicit Robot(model::RobotDescription description);
  Robot(const Robot&) = delete;
  Robot& operator=(const Robot&) = delete;

  [[nodiscard]] const model::RobotDescription& description() const { return description_; }
  /// That a scenario can name; it goes with the object if it was guessed.
  [[nodiscard]] const std::string& file() const { return file_; }
  /// The path that makes the same robot again; empty: there is none.
  [[nodiscard]] const std::string& source() const { return source_; }
  [[nodiscard]] model::RobotModel& model();
  [[nodiscard]] const model::Frames& frames();

 private:
  void guess(const doctor::Diagnosis& diagnosis);

  model::RobotDescription description_;
  std::string file_, source_;
  std::shared_ptr<const doctor::GuessedFile> guessed_;
  std::optional<model::RobotModel> model_;  // once they are asked for
  std::optional<model::Frames> frames_;
};

}  // namespace surefoot::python
