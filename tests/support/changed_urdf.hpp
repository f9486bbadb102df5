#pragma once

#include "tests/logging/temporary_folder.hpp"
#include "tests/support/anymal_b.hpp"

#include <gtest/gtest.h>

#include <string>

namespace surefoot::test {

/// The URDF of ANYmal B with places of its text changed, in a file that goes away with the object.
class ChangedUrdf {
 public:
  ChangedUrdf() : robot_(anymal_b()), text_(contents(robot_.urdf_path)) {
    robot_.urdf_path = folder_ / "changed.urdf";
    write_file(robot_.urdf_path, text_);
  }
  ChangedUrdf(const std::string& from, const std::string& to) : ChangedUrdf() { change(from, to); }

  /// Changes the first place where the text stands.
  void change(const std::string& from, const std::string& to) {
    const std::size_t place = text_.find(from);
    ASSERT_NE(place, std::string::npos) << from;
    text_.replace(place, from.size(), to);
    write_file(robot_.urdf_path, text_);
  }

  [[nodiscard]] const model::RobotDescription& robot() const { return robot_; }

 private:
  TemporaryFolder folder_;
  model::RobotDescription robot_;
  std::string text_;
};

}  // namespace surefoot::test
