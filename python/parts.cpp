// Estimators, planners and tasks that are written in Python.

#include "python/parts.hpp"

#include "python/bindings.hpp"
#include "python/dynamics.hpp"
#include "python/in_python.hpp"
#include "python/named_command.hpp"
#include "python/numbers.hpp"
#include "surefoot/estimation/leg_inertial_estimator.hpp"
#include "surefoot/tasks/task.hpp"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace surefoot::python {

std::string text_of(const nb::object& object) {
  return nb::cast<std::string>(nb::str(nb::handle(object)));
}

std::string one_line(const nb::python_error& error) {
  const std::string name = text_of(error.type().attr("__name__"));
  const std::string what = text_of(nb::borrow<nb::object>(error.value()));
  if (!error.traceback().is_valid()) return name + ": " + what;  // raised by C
  const nb::object frames = nb::module_::import_("traceback").attr("extract_tb")(error.traceback());
  if (nb::len(frames) == 0) return name + ": " + what;
  // The innermost one in the user's file: where a library raised helps less.
  const std::string file = text_of(nb::object(frames[0]).attr("filename"));
  nb::object last = frames[0];
  for (const nb::handle frame : frames)
    if (text_of(frame.attr("filename")) == file) last = nb::borrow(frame);
  return name + ": " + what + " (" + file.substr(file.rfind('/') + 1) + ", line " +
         text_of(last.attr("lineno")) + ")";
}

std::string wrong_result(nb::handle object, const char* method, nb::handle result,
                         const std::string& valid) {
  return text_of(object.type().attr("__name__")) + "." + method + " returned " +
         text_of(nb::repr(result)) + "; " + valid + " would be valid";
}

namespace {

// Estimator.

/// A base class in Python that can ask the library's part, which is made anew with each controller.
template <typename Part>
struct BoundPart {
  std::function<std::unique_ptr<Part>()> make;
  std::unique_ptr<Part> library = make ? make() : nullptr;
};

/// Throws Error if the object has no update() of its own, and no library's to ask, or one that
/// takes other arguments. `takes`: what is valid.
void check_update(nb::handle object, nb::handle base, bool asks_library, const char* takes) {
  const std::string name = text_of(object.type().attr("__name__"));
  const nb::object update = object.attr("update");
  const nb::object function = nb::getattr(update, "__func__", update);
  if (function.is(base.attr("update"))) {
    if (asks_library) return;
    throw Error(name + " has no update(self, " + takes + ")");
  }
  nb::module_::import_("surefoot._arguments").attr("check_takes")(name + ".update", update, takes);
}

/// Before a controller takes it: what it remembers of another run is gone.
template <typename Bound>
void begin_anew(const SharedObject& object, const char* takes) {
  const nb::gil_scoped_acquire python;
  if (nb::inst_check(*object) && !nb::inst_ready(*object))
    throw Error(text_of((*object).type().attr("__name__")) +
                ".__init__ must call super().__init__() first");
  Bound* base = nullptr;
  (void)nb::try_cast<Bound*>(*object, base);
  check_update(*object, nb::type<Bound>(), base != nullptr && base->make, takes);
  (*object).attr("restart")();
  if (base != nullptr && base->make) base->library = base->make();
}

/// `Estimator` in Python.
struct BoundEstimator : BoundPart<estimation::StateEstimator> {
  [[nodiscard]] estimation::StateEstimator& asked() const {
    if (library) return *library;
    throw Error("Estimator() estimates nothing by itself: write update(), or give it a scenario");
  }
};

class PythonEstimator final : public estimation::StateEstimator {
 public:
  explicit PythonEstimator(const SharedObject& object) : object_(object) {}

  const RobotState& update(const SensorReading& reading, const TickContext& context) override {
    in_python([&] {
      const nb::object result = (*object_).attr("update")(reading, context);
      state_ = result_of<RobotState>(*object_, "update", "RobotState", result);
    });
    return state_;
  }
  void restart() override {
    in_python([&] { (*object_).attr("restart")(); });
  }

 private:
  SharedObject object_;
  RobotState state_;
};

void bind_estimator(nb::module_& module) {
  using Self = BoundEstimator;
  nb::class_<Self>(module, "Estimator",
                   "Estimates the state from sensor readings. Derive your own and write update(); "
                   "what it raises "
                   "makes the\ncontroller act as without a state: it holds, then sits down.",
                   nb::type_slots(kNoVectorcall))
      .def(nb::init<>())
      .def(
          "__init__",
          [](Self* self, const config::Scenario& scenario) {
            new (self) Self{{[robot = scenario.robot, options = scenario.estimator,
                              period = scenario.controller.period] {
              return std::make_unique<estimation::LegInertialEstimator>(robot, options, period);
            }}};
          },
          nb::arg("scenario"), "With the library's, which super().update() then asks.")
      .def(
          "update",
          [](Self& self, const SensorReading& reading, const TickContext& context) {
            return self.asked().update(reading, context);
          },
          nb::arg("reading"), nb::arg("context"),
          "A tick: the state now, in a world W of its own. Numbers that are not known are NaN; the "
          "controller\nestimates foot_force itself.")
      .def(
          "restart",
          [](Self& self) {
            if (self.library) self.library->restart();
          },
          "Forgets all readings so far: called when a controller is made with it, and where the "
          "robot is set down elsewhere.");
}

// Planner.

/// `Planner` in Python.
using BoundPlanner = BoundPart<gaits::MotionPlanner>;

class PythonPlanner final : public gaits::MotionPlanner {
 public:
  PythonPlanner(const SharedObject& object, const model::RobotDescription& robot)
      : object_(object), robot_(std::make_shared<Robot>(robot)) {
    (void)nb::try_cast<BoundPlanner*>(*object, base_);
  }

  const MotionPlan& update(const UserCommand& user, const RobotState& state,
                           const model::Dynamics& dynamics, const HierarchyOutcome& last) override {
    in_python([&] {
      const nb::object result = (*object_).attr("update")(NamedCommand(user), state,
                                                          NamedDynamics{robot_, dynamics}, last);
      plan_ = result_of<MotionPlan>(*object_, "update", "MotionPlan", result);
    });
    return plan_;
  }
  void restart() override {
    in_python([&] { (*object_).attr("restart")(); });
  }
  int steps_taken() const noexcept override { return library() ? library()->steps_taken() : 0; }
  void set_friction(double friction) override {
    library() ? library()->set_friction(friction) : MotionPlanner::set_friction(friction);
  }
  Vec3 terrain_normal(const MotionPlan& last) const noexcept override {
    return library() ? library()->terrain_normal(last) : MotionPlanner::terrain_normal(last);
  }
  bool restarts() const noexcept override { return library() && library()->restarts(); }
  bool is_undisturbed(const RobotState& state) const noexcept override {
    return library() && library()->is_undisturbed(state);
  }
  void tell_calibration_known(bool known) noexcept override {
    if (library()) library()->tell_calibration_known(known);
  }

 private:
  /// That of the object; null: it asks none.
  [[nodiscard]] gaits::MotionPlanner* library() const {
    return base_ == nullptr ? nullptr : base_->library.get();
  }

  SharedObject object_;
  std::shared_ptr<Robot> robot_;
  BoundPlanner* base_ = nullptr;
  MotionPlan plan_;
};

MotionPlan standing_plan(const NamedDynamics& dynamics, double time, double friction,
                         double force_max) {
  const model::Dynamics& now = dynamics.values;
  const int num_legs = now.num_legs();
  MotionPlan plan;
  plan.time = time;
  plan.feet.resize(num_legs);
  Vec3 center = Vec3::Zero();
  for (const Leg leg : now.foot.legs()) {
    FootPlan& foot = plan.feet[index(leg)];
    foot.p_WF = now.foot[index(leg)].p;
    foot.force_max = force_max;
    foot.friction = friction;
    center += foot.p_WF / num_legs;
  }
  const Vec3 forward = now.base_rotation.R.col(0);
  const double yaw = std::atan2(forward.y(), forward.x());
  plan.R_WC = Eigen::AngleAxisd(yaw, Vec3::UnitZ()).toRotationMatrix();
  plan.torso.q_WB = Quat(plan.R_WC);
  plan.torso.height = now.base.p.z();
  plan.com.p = plan.com.zmp = center.head<2>();
  plan.terrain_point = center;
  return plan;
}

void bind_planner(nb::module_& module) {
  nb::class_<HierarchyOutcome>(module, "HierarchyOutcome",
                               "What the hierarchy made of the plan before.")
      .def_ro("tilt_shortfall", &HierarchyOutcome::tilt_shortfall,
              "unmet share of the torso's roll and pitch acceleration [rad/s²]; NaN: not known");
  using Self = BoundPlanner;
  nb::class_<Self>(module, "Planner",
                   "Plans the motion that the tasks follow. Derive your own and write update(); of "
                   "what it raises the\ncontroller tells you, holds its posture, then sits down.",
                   nb::type_slots(kNoVectorcall))
      .def(nb::init<>())
      .def(
          "__init__",
          [](Self* self, const config::Scenario& scenario) {
            new (self) Self{[options = scenario.controller, scale = scenario.robot.scale] {
              return gaits::make_planner(options.planner, options.period, scale, options.gaits,
                                         options.first_gait);
            }};
          },
          nb::arg("scenario"), "With the library's, which super().update() then asks.")
      .def(
          "update",
          [](Self& self, const NamedCommand& user, const RobotState& state,
             const NamedDynamics& dynamics, const HierarchyOutcome& last) {
            if (!self.library)
              throw Error(
                  "Planner() plans nothing by itself: write update(), or give it a scenario");
            return self.library->update(user, state, dynamics.values, last);
          },
          nb::arg("user"), nb::arg("state"), nb::arg("dynamics"), nb::arg("last"),
          "A tick: the plan now. `dynamics` is the robot at `state`.")
      .def(
          "restart",
          [](Self& self) {
            if (self.library) self.library->restart();
          },
          "Forgets all plans: called when a controller is made with it, and where the robot may "
          "stand elsewhere.");
  module.def(
      "standing_plan", &standing_plan, nb::arg("dynamics"), nb::arg("time") = 0.0,
      nb::arg("friction") = 0.5, nb::arg("force_max") = 1000.0,
      "A plan to begin with: all feet stand where they are, the torso is level at its height, "
      "the centre of mass between the feet.");
}

// Task.

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

template <typename Array>
Array numbers(nb::handle given, const char* what) {
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
    name_ = nb::cast<std::string>(task.attr("task"));
    const nb::object most = task.attr("max_rows");
    if (!nb::try_cast<int>(most, max_rows_) || max_rows_ < 1 || max_rows_ > tasks::Task::kMostRows)
      throw Error("task \"" + name_ + "\": max_rows is " + text_of(nb::repr(most)) +
                  "; the largest number of rows that rows() gives, from 1 to " +
                  std::to_string(tasks::Task::kMostRows) + ", is valid");
    row_names_ = nb::cast<std::vector<std::string>>(task.attr("row_names"));
  }

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
  std::string name_;
  int max_rows_ = 0;
  std::vector<std::string> row_names_;
  mutable std::shared_ptr<Robot> robot_;  // made when it is known
};

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

}  // namespace

std::unique_ptr<estimation::StateEstimator> own_estimator(const SharedObject& object,
                                                          const model::RobotDescription&) {
  begin_anew<BoundEstimator>(object, "reading, context");
  return std::make_unique<PythonEstimator>(object);
}

std::unique_ptr<gaits::MotionPlanner> own_planner(const SharedObject& object,
                                                  const model::RobotDescription& robot) {
  begin_anew<BoundPlanner>(object, "user, state, dynamics, last");
  const nb::gil_scoped_acquire python;
  return std::make_unique<PythonPlanner>(object, robot);
}

tasks::OwnTasks own_tasks(const nb::list& list) {
  tasks::OwnTasks own;
  for (const nb::handle each : list) {
    if (!nb::hasattr(each, "rows"))
      throw Error("own has " + text_of(nb::repr(each)) + "; an OwnTask would be valid");
    const SharedObject object(nb::borrow<nb::object>(each));
    (void)PythonTask(object);  // refuses one without rows
    own.add({.info = {.name = nb::cast<std::string>(each.attr("task")),
                      .unit = nb::cast<std::string>(each.attr("unit"))},
             .make = [object](const tasks::TaskParameters&) -> std::unique_ptr<tasks::Task> {
               const nb::gil_scoped_acquire python;
               return std::make_unique<PythonTask>(object);
             }});
  }
  return own;
}

void bind_parts(nb::module_& module) {
  bind_estimator(module);
  bind_planner(module);
  bind_task_tick(module);
}

}  // namespace surefoot::python
