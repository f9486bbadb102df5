#pragma once

#include "surefoot/tasks/task_entry.hpp"

#include <functional>
#include <memory>
#include <string>
#include <utility>

namespace surefoot::test {

/// A task of a user: one row that asks for an upward acceleration of the base; or what `write`
/// does.
class OwnTask final : public tasks::Task {
 public:
  using Write = std::function<void(const OwnTask&, const tasks::TaskInput&, solver::Level&)>;

  struct Options {
    double acceleration = 0.0;  // [m/s²]
  };

  explicit OwnTask(const Options& options) : options_(options) {}
  explicit OwnTask(Write write) : write_(std::move(write)) {}

  void write(const tasks::TaskInput& input, solver::Level& level) const override {
    if (write_) return write_(*this, input, level);
    solver::Rows rows = level.add(1, first_id());
    rows.A(0, 2) = 1.0;
    rows.set_equal(0, options_.acceleration);
  }
  [[nodiscard]] int max_rows() const override { return 1; }
  [[nodiscard]] std::string_view name() const override { return "own"; }
  [[nodiscard]] std::string row_name(int) const override { return "base upward"; }

 private:
  Options options_;
  Write write_;
};

inline tasks::TaskDefinition own_task(OwnTask::Write write) {
  return {.info = {.name = "own", .unit = "m/s²"},
          .make = [write = std::move(write)](const tasks::TaskParameters&) {
            return std::make_unique<OwnTask>(write);
          }};
}

inline tasks::OwnTasks own_tasks() {
  tasks::OwnTasks own;
  tasks::TaskEntry<OwnTask>("own", "the base rises", "–", "m/s²")
      .number("acceleration", &OwnTask::Options::acceleration, "m/s²", "upward")
      .add_to(own);
  return own;
}

}  // namespace surefoot::test
