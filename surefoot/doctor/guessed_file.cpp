#include "surefoot/doctor/guessed_file.hpp"

#include "surefoot/doctor/robot_file_text.hpp"

namespace surefoot::doctor {

GuessedFile::GuessedFile(const Diagnosis& robot)
    : path_(folder_.write("robot.yaml",
                          robot_file_text(robot, folder_.path(), Guesses::as_numbers))) {}

std::string GuessedFile::without_path(std::string message) const {
  for (std::size_t at = message.find(path_); at != std::string::npos; at = message.find(path_))
    message.replace(at, path_.size(), "robot file");
  return message;
}

}  // namespace surefoot::doctor
