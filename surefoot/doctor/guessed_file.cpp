#include "surefoot/doctor/guessed_file.hpp"

#include "surefoot/doctor/robot_file_text.hpp"

#include <algorithm>

namespace surefoot::doctor {

GuessedFile::GuessedFile(const Diagnosis& robot)
    : is_guess_(robot.robot_file.empty()),
      path_(is_guess_ ? folder_.write("robot.yaml",
                                      robot_file_text(robot, folder_.path(), Guesses::as_numbers))
                      : robot.robot_file) {}

std::string GuessedFile::without_path(std::string message) const {
  if (!is_guess_) return message;
  // With the line behind it, ":10: ": nobody sees that file.
  for (std::size_t at = message.find(path_); at != std::string::npos; at = message.find(path_)) {
    const std::size_t end =
        std::min(message.find_first_not_of(":0123456789", at + path_.size()), message.size());
    message.replace(at, end - at, end > at + path_.size() ? "robot file:" : "robot file");
  }
  return message;
}

}  // namespace surefoot::doctor
