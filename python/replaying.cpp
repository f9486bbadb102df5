// Logs that are computed again: what surefoot_log/recorded.py needs.

#include "python/bindings.hpp"
#include "python/own_parts.hpp"
#include "python/robot.hpp"
#include "python/while_others_run.hpp"
#include "surefoot/replay/log_verification.hpp"
#include "surefoot/replay/replay_json.hpp"
#include "surefoot/replay/stack_comparison.hpp"

#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>

#include <functional>
#include <memory>
#include <string>

namespace surefoot::python {
namespace {

std::string verified(const std::string& log, const nb::object& own, const nb::object& planner) {
  replay::ReplayOptions options{.state = replay::ReplayedState::estimated,
                                .own_tasks = own_tasks_of_run(own)};
  if (!planner.is_none())
    options.make_planner = [shared = SharedObject(planner)](const model::RobotDescription& robot) {
      return own_planner(shared, robot);
    };
  return while_others_run([&](const std::function<bool()>& stops) {
    return replay::json_of(log, replay::verify_log(log, options, stops));
  });
}

std::string compared(const std::string& log, const std::string& stack, const nb::object& own) {
  const tasks::OwnTasks tasks = own_tasks_of_run(own);
  return while_others_run([&](const std::function<bool()>& stops) {
    return replay::json_of(log, replay::compare_stack(log, stack, {}, tasks, stops));
  });
}

/// A stack of the user's with its own tasks; `text_for(robot)` is its text.
std::string compared_with(const std::string& log, const nb::callable& text_for,
                          const std::string& name, const nb::list& tasks, const nb::object& own) {
  const tasks::OwnTasks of_stack = own_tasks(tasks), of_run = own_tasks_of_run(own);
  const replay::MakeStack make_stack = [&](const replay::LogReplay& run) {
    const Interpreter::Locked python;
    const nb::object text = text_for(std::make_shared<Robot>(run.robot()));
    return stack_for(run.robot(), nb::cast<std::string>(text), name, of_stack);
  };
  return while_others_run([&](const std::function<bool()>& stops) {
    return replay::json_of(log, replay::compare_stack(log, make_stack, {}, of_run, stops));
  });
}

}  // namespace

void bind_replaying(nb::module_& module) {
  module.def("verify_log", &verified, nb::arg("log"), nb::arg("own_tasks"),
             nb::arg("planner").none(),
             nb::sig("def verify_log(log: str, own_tasks: typing.Sequence[typing.Any], planner: "
                     "Planner | None) -> str"));
  module.def("compare_stack", &compared, nb::arg("log"), nb::arg("stack"), nb::arg("own_tasks"),
             nb::sig("def compare_stack(log: str, stack: str, own_tasks: "
                     "typing.Sequence[typing.Any]) -> str"));
  module.def("compare_made_stack", &compared_with, nb::arg("log"), nb::arg("text_for"),
             nb::arg("name"), nb::arg("tasks"), nb::arg("own_tasks"),
             nb::sig("def compare_made_stack(log: str, text_for: typing.Callable[[Robot], str], "
                     "name: str, tasks: list[typing.Any], own_tasks: typing.Sequence[typing.Any]) "
                     "-> str"));
}

}  // namespace surefoot::python
