// Tasks that are written in Python.

#include "python/bindings.hpp"
#include "python/dynamics.hpp"
#include "python/in_python.hpp"
#include "python/interpreter.hpp"
#include "python/numbers.hpp"
#include "python/own_parts.hpp"
#include "surefoot/tasks/task.hpp"

#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace surefoot::python {
namespace {

/// What a task is given at a tick; `TaskTick` in Python.
struct TaskTick {
  NamedDynamics dynamics;
  MotionPlan plan;
  Eigen::Index unknowns;
  model::SupportDynamics support;
};

using Numbers1 = nb::ndarray<const double, nb::ndim<1>, nb::c_contig, nb::device::cpu>;
using Numbers2 = nb::ndarray<const double, nb::ndim<2>, nb::c_contig, nb::device::cpu>;

/// As the package shows an argument.
std::string shown_short(nb::handle given) {
  return text_of(nb::module_::import_("surefoot._arguments").attr("shown")(given));
}

[[noreturn]] void refuse(const nb::object& task, const char* attribute, const std::string& valid) {
  throw Error("task \"" + text_of(task.attr("task")) + "\": " + attribute + " is " +
              shown_short(task.attr(attribute)) + "; " + valid + " would be valid");
}

/// Of a task of the user's. Throws Error if it is none; `valid`: what would be.
template <typename T>
T attribute(const nb::object& task, const char* name, const std::string& valid) {
  T value;
  if (!nb::try_cast(task.attr(name), value)) refuse(task, name, valid);
  return value;
}

template <typename Array>
Array numbers(nb::handle given, const char* what) {
  const nb::object type = nb::getattr(given, "dtype", nb::none());
  if (text_of(nb::getattr(type, "kind", nb::none())) == "c")
    throw Error(std::string("rows() gave ") + what +
                " of complex numbers; real ones would be valid");
  const nb::object made =
      nb::module_::import_("numpy").attr("ascontiguousarray")(given, nb::arg("dtype") = "float64");
  Array array;
  if (nb::try_cast<Array>(made, array)) return array;
  throw Error(std::string("rows() gave ") + what + " of shape " + text_of(made.attr("shape")) +
              "; A of shape (rows, unknowns) and bounds of shape (rows,) would be valid");
}

class PythonTask final : public tasks::Task {
 public:
  explicit PythonTask(const SharedObject& object) : object_(object) {
    const nb::object& task = *object;
    name_ = attribute<std::string>(task, "task", "a text");
    unit_ = attribute<std::string>(task, "unit", "a text");
    row_names_ = attribute<std::vector<std::string>>(task, "row_names", "a list of texts");
    const std::string most = "the largest number of rows that rows() gives, from 1 to " +
                             std::to_string(tasks::Task::kMostRows) + ",";
    max_rows_ = attribute<int>(task, "max_rows", most);
    if (max_rows_ < 1 || max_rows_ > tasks::Task::kMostRows) refuse(task, "max_rows", most);
    if (row_names_.size() > static_cast<std::size_t>(max_rows_))
      throw Error("task \"" + name_ + "\": row_names has " + std::to_string(row_names_.size()) +
                  " names, and max_rows is " + std::to_string(max_rows_) +
                  "; as many names as rows, or fewer, are valid");
  }

  [[nodiscard]] const std::string& unit() const { return unit_; }
  int max_rows() const override { return max_rows_; }
  std::string_view name() const override { return name_; }
  std::string row_name(int id) const override {
    const auto place = static_cast<std::size_t>(id);
    return place < row_names_.size() ? row_names_[place] : "row " + std::to_string(id);
  }

  void write(const tasks::TaskInput& input, solver::Level& level) const override {
    in_python([&] {
      if (!robot_) robot_ = std::make_shared<Robot>(input.robot);
      const nb::object given = (*object_).attr("rows")(
          TaskTick{{robot_, input.dynamics}, input.plan, level.unknowns(), input.support});
      if (!given.is_none()) append(given, input.dynamics.num_velocities(), level);
    });
  }

 private:
  void append(nb::handle given, Eigen::Index num_velocities, solver::Level& level) const {
    const std::size_t count = nb::isinstance<nb::tuple>(given) ? nb::len(given) : 0;
    if (count != 2 && count != 3)
      throw Error("rows() gave " + shown_short(given) +
                  "; (A, b) for A x = b, (A, lower, upper) or None would be valid");
    const auto A = numbers<Numbers2>(given[0], "A");
    const auto lower = numbers<Numbers1>(given[1], "a bound");
    const auto upper = numbers<Numbers1>(given[count - 1], "a bound");
    const auto num_rows = static_cast<Eigen::Index>(A.shape(0));
    const auto columns = static_cast<Eigen::Index>(A.shape(1));
    if (columns != num_velocities && columns != level.unknowns())
      throw Error("rows() gave A with " + std::to_string(columns) + " columns; " +
                  std::to_string(num_velocities) + ", one for each acceleration, or " +
                  std::to_string(level.unknowns()) + " with the torques would be valid");
    if (lower.size() != A.shape(0) || upper.size() != A.shape(0))
      throw Error("rows() gave " + std::to_string(num_rows) + " rows, but " +
                  std::to_string(lower.size()) + " lower and " + std::to_string(upper.size()) +
                  " upper bounds");
    if (num_rows > max_rows_)
      throw Error("rows() gave " + std::to_string(num_rows) + " rows, and max_rows is " +
                  std::to_string(max_rows_));
    solver::Rows rows = level.add(num_rows, first_id());
    rows.A.leftCols(columns) =
        Eigen::Map<const solver::Rows::RowMajor>(A.data(), num_rows, columns);
    rows.lower = Eigen::Map<const Eigen::VectorXd>(lower.data(), num_rows);
    rows.upper = Eigen::Map<const Eigen::VectorXd>(upper.data(), num_rows);
  }

  SharedObject object_;
  std::string name_, unit_;
  int max_rows_ = 0;
  std::vector<std::string> row_names_;
  mutable std::shared_ptr<Robot> robot_;  // made when it is known
};

}  // namespace

void bind_task_tick(nb::module_& module) {
  using Self = TaskTick;
  nb::class_<Self>(module, "TaskTick", "What a task of your own is given at a tick.")
      .def_ro("dynamics", &Self::dynamics, "the robot as the controller believes it")
      .def_ro("plan", &Self::plan, "what to follow")
      .def_ro("unknowns", &Self::unknowns,
              "of x = (u̇, τ): the accelerations, then the torques of all joints")
      .def(
          "force",
          [](const Self& self, const std::string& leg) {
            for (const Leg each : self.plan.feet.legs()) {
              if (leg_name(each, self.dynamics.values.num_legs()) != leg) continue;
              Eigen::MatrixXd map = Eigen::MatrixXd::Zero(3, self.unknowns + 1);
              const int first = self.support.first_force(each);
              if (first >= 0) {
                map.leftCols(self.unknowns) = self.support.Lambda().middleRows(first, 3);
                map.col(self.unknowns) = self.support.lambda_0().segment<3>(first);
              }
              return nb::module_::import_("numpy").attr("array")(view(map, nb::handle()));
            }
            throw UnknownNameError("no leg \"" + leg + "\"; plan.feet has their names");
          },
          nb::arg("leg"),
          nb::sig("def force(self, leg: str) -> numpy.typing.NDArray[numpy.float64]"),
          "Of the ground on a foot in W [N], F x + f, as the columns (F, f); zero for a foot in "
          "the air.");
}

tasks::OwnTasks own_tasks(const nb::list& list) {
  tasks::OwnTasks own;
  for (const nb::handle each : list) {
    if (!nb::hasattr(each, "rows"))
      throw Error("own_tasks has " + text_of(nb::repr(each)) + "; an OwnTask would be valid");
    const SharedObject object(nb::borrow<nb::object>(each));
    const PythonTask task(object);  // refuses one that makes no sense
    own.add({.info = {.name = std::string(task.name()), .unit = task.unit()},
             .make = [object](const tasks::TaskParameters&) -> std::unique_ptr<tasks::Task> {
               const Interpreter::Locked python;
               return std::make_unique<PythonTask>(object);
             }});
  }
  return own;
}

tasks::OwnTasks own_tasks_of_run(const nb::object& given) {
  return own_tasks(nb::list(nb::module_::import_("surefoot.task").attr("with_registered")(given)));
}

}  // namespace surefoot::python
