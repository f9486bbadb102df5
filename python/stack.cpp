// What surefoot/stack.py, surefoot/task.py and the generator of surefoot/tasks.py need: the catalog
// of tasks, and stacks as plain data.

#include "python/bindings.hpp"
#include "python/own_parts.hpp"
#include "python/robot.hpp"
#include "surefoot/config/data_file.hpp"
#include "surefoot/config/stack_file.hpp"
#include "surefoot/config/stack_text.hpp"
#include "surefoot/control/stack_reach.hpp"
#include "surefoot/tasks/catalog.hpp"
#include "surefoot/tasks/check_task.hpp"

#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/vector.h>

#include <string>
#include <string_view>
#include <vector>

namespace surefoot::python {
namespace {

nb::dict as_dict(const tasks::TaskInfo& info) {
  nb::dict result;
  result["name"] = info.name;
  result["summary"] = info.summary;
  result["equation"] = info.equation;
  result["unit"] = info.unit;
  nb::list numbers, choices;
  for (const tasks::TaskParameter& parameter : info.parameters) {
    nb::dict number;
    number["name"] = parameter.name;
    number["default"] = parameter.default_value;
    number["unit"] = parameter.unit;
    number["help"] = parameter.help;
    numbers.append(number);
  }
  for (const tasks::TaskChoice& each : info.choices) {
    nb::dict choice;
    choice["name"] = each.name;
    choice["values"] = each.values;
    choice["default"] = each.default_value;
    choice["help"] = each.help;
    choice["others"] = each.others;
    choices.append(choice);
  }
  result["numbers"] = numbers;
  result["choices"] = choices;
  return result;
}

nb::list as_list(const control::StackOptions& stack) {
  nb::list levels;
  for (const control::LevelSpec& level : stack.levels) {
    nb::list tasks;
    for (const control::TaskSpec& spec : level.tasks) {
      nb::dict parameters;
      for (const auto& [name, value] : spec.numbers) parameters[name.c_str()] = value;
      for (const auto& [name, value] : spec.choices) parameters[name.c_str()] = value;
      tasks.append(nb::make_tuple(spec.task, spec.weight, parameters));
    }
    levels.append(nb::make_tuple(level.name, level.damping, tasks));
  }
  return levels;
}

/// A robot's, or that of ANYmal B.
Scale scale_of(const Robot* robot) {
  return robot == nullptr ? Scale{} : robot->description().scale;
}

}  // namespace

control::StackOptions stack_for(const model::RobotDescription& robot, const std::string& text,
                                const std::string& name, const tasks::OwnTasks& own) {
  control::StackOptions stack =
      config::with_scaled_arms(config::parse_stack(text, name, robot.scale, own), robot);
  control::check_physics(stack);
  control::check_reach(stack, control::reach_of(model::RobotModel(robot)));
  return stack;
}

void bind_stack(nb::module_& module) {
  const char* levels =
      "-> list[tuple[str, float, list[tuple[str, float, dict[str, float | str]]]]]";
  module.def(
      "try_task",
      [](const nb::object& task, const Robot& robot) {
        std::vector<std::string> wrong =
            tasks::check_task(nb::cast<std::string>(task.attr("name")), robot.description(),
                              own_tasks(nb::list(nb::make_tuple(task))));
        constexpr std::string_view kCalled = "write() threw";  // in C++
        for (std::string& each : wrong) {
          const std::size_t at = each.find(kCalled);
          if (at != std::string::npos) each.replace(at, kCalled.size(), "rows() raised");
        }
        return wrong;
      },
      nb::arg("task"), nb::arg("robot"),
      nb::sig("def try_task(task: typing.Any, robot: Robot) -> list[str]"));
  module.def(
      "catalog",
      [] {
        nb::list tasks;
        for (const tasks::TaskInfo& info : tasks::task_catalog()) tasks.append(as_dict(info));
        return tasks;
      },
      nb::sig("def catalog() -> list[dict[str, typing.Any]]"),
      "All tasks that a stack may have, with their parameters.");
  module.def(
      "stack_levels",
      [](const std::string& name_or_path, const Robot* robot, const nb::list& own) {
        return as_list(config::load_stack(name_or_path, {}, scale_of(robot), own_tasks(own)));
      },
      nb::arg("name_or_path"), nb::arg("robot") = nb::none(), nb::arg("own") = nb::list(),
      nb::sig((std::string("def stack_levels(name_or_path: str, robot: Robot | None = None, own: "
                           "typing.Sequence[typing.Any] = ()) ") +
               levels)
                  .c_str()),
      "The levels of a stack file: (name, damping, [(task, weight, parameters)]).");
  module.def(
      "stack_name",
      [](const std::string& name_or_path, const nb::list& own) {
        return config::load_stack(name_or_path, {}, {}, own_tasks(own)).name;
      },
      nb::arg("name_or_path"), nb::arg("own"),
      nb::sig("def stack_name(name_or_path: str, own: list[typing.Any]) -> str"));
  module.def(
      "parse_stack",
      [](const std::string& text, const std::string& name, const Robot* robot,
         const nb::list& own) {
        return as_list(config::with_defaults(
            config::parse_stack(text, name, scale_of(robot), own_tasks(own))));
      },
      nb::arg("text"), nb::arg("name"), nb::arg("robot") = nb::none(), nb::arg("own") = nb::list(),
      nb::sig((std::string("def parse_stack(text: str, name: str, robot: Robot | None = None, own: "
                           "list[typing.Any] = []) ") +
               levels)
                  .c_str()),
      "The same for a stack file's text, with every parameter. Raises Error on what is wrong.");
  module.def(
      "stacks",
      [] {
        nb::typed<nb::dict, std::string, std::string> descriptions;
        for (const std::string& name : config::list_data("stacks"))
          descriptions[nb::cast(name)] = nb::cast(config::describe_data("stacks", name));
        return descriptions;
      },
      "The stacks that there are: name → what it is for.");
  module.def(
      "robots", [] { return config::list_data("robots"); },
      "Names of the robots that ship; the URDFs of some come with other packages.");
}

}  // namespace surefoot::python
