// Whole runs.

#include "python/bindings.hpp"
#include "python/controller.hpp"
#include "python/interpreter.hpp"
#include "python/interrupt.hpp"
#include "python/metrics.hpp"
#include "python/own_parts.hpp"
#include "python/plant.hpp"
#include "surefoot/base/formatted.hpp"
#include "surefoot/base/nearest_name.hpp"
#include "surefoot/closed_loop/closed_loop.hpp"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <cstdint>
#include <exception>
#include <functional>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace surefoot::python {
namespace {

using evaluation::CriterionResult;

/// `Result` in Python: data, which `pickle` may send to another process.
struct Result {
  std::string scenario;
  std::optional<std::string> log;
  evaluation::Metrics metrics;
  std::vector<CriterionResult> criteria;
  std::vector<std::string> events, notes;
  std::string fault;
  std::uint64_t torques_hash = 0;
};

/// Of events and troubles, a line each.
std::vector<std::string> event_lines(const closed_loop::RunResult& run) {
  std::vector<std::string> lines;
  for (const evaluation::EventCount& each : run.events)
    lines.push_back(std::string(name(each.event)) +
                    formatted(": %d, first at %.4f s", each.count, each.first));
  for (const closed_loop::TroubleCount& each : run.troubles)
    lines.push_back(each.what + formatted(": %d, first at %.4f s", each.count, each.first));
  return lines;
}

using ResultState =
    std::tuple<std::string, std::optional<std::string>, Metrics, std::vector<CriterionResult>,
               std::vector<std::string>, std::vector<std::string>, std::string, std::uint64_t>;

void bind_result(nb::module_& module) {
  using Self = Result;
  nb::class_<Self>(module, "Result", "How a run went.")
      .def_prop_ro(
          "succeeded", [](const Self& self) { return self.metrics.succeeded; },
          "all criteria held, the controller did not stop, and no part of your own failed; None: "
          "not "
          "judged")
      .def_prop_ro(
          "reason", [](const Self& self) { return self.metrics.reason; }, "why it ended")
      .def_prop_ro(
          "metrics", [](const Self& self) { return as_dict(self.metrics); },
          nb::sig("def metrics(self) -> dict[str, typing.Any]"),
          "by name, each with its unit in it; NaN: not measured")
      .def_prop_ro(
          "fault", [](const Self& self) { return self.fault; },
          "what a part of your own did wrong last; empty if nothing")
      .def_prop_ro(
          "criteria", [](const Self& self) { return self.criteria; }, "of the scenario")
      .def_ro("events", &Self::events, "notable ones, and faults: a line each")
      .def_prop_ro(
          "notes", [](const Self& self) { return self.notes; }, "lines worth telling")
      .def_prop_ro(
          "torques_hash", [](const Self& self) { return self.torques_hash; },
          "of all commanded torques: equal for runs that are equal to the bit")
      .def_ro("log", &Self::log, "its path, if it was recorded")
      .def(
          "__getitem__",
          [](const Self& self, const std::string& metric) {
            const Metrics metrics = as_dict(self.metrics);
            if (!metrics.contains(metric.c_str())) {
              const auto names = nb::cast<std::vector<std::string>>(nb::list(metrics));
              throw nb::key_error(
                  ("there is no metric \"" + metric + "\"; " + near_names(metric, names)).c_str());
            }
            return nb::object(metrics[metric.c_str()]);
          },
          nb::sig("def __getitem__(self, metric: str) -> typing.Any"))
      .def("__repr__",
           [](const Self& self) {
             std::string missed;
             for (const CriterionResult& each : self.criteria)
               if (each.passed == false)
                 missed += (missed.empty() ? "; missed: " : ", ") + each.criterion.metric;
             return "<run of " + self.scenario +
                    (!self.metrics.succeeded   ? ", not judged"
                     : *self.metrics.succeeded ? ", succeeded"
                                               : ", did not succeed") +
                    formatted(", %.4g s: ", self.metrics.duration_s) + self.metrics.reason +
                    missed + ">";
           })
      .def(
          "__getstate__",
          [](const Self& self) {
            return ResultState(self.scenario, self.log, as_dict(self.metrics), self.criteria,
                               self.events, self.notes, self.fault, self.torques_hash);
          },
          nb::sig("def __getstate__(self) -> tuple[typing.Any, ...]"))
      .def("__setstate__", [](Self& self, const ResultState& state) {
        const auto& [scenario, log, metrics, criteria, events, notes, fault, torques_hash] = state;
        new (&self)
            Self{scenario, log, metrics_of(metrics), criteria, events, notes, fault, torques_hash};
      });
}

/// What a run's callback is given before each tick; `Tick` in Python.
struct Tick {
  BoundPlant plant;
  BoundController controller;
  NamedCommand user;
  bool stops = false;

  /// The run goes on until it pauses.
  void resume() {
    plant.resume();
    controller.resume();
  }
  void pause() {
    plant.pause();
    controller.pause();
  }
  void end() {
    plant.end();
    controller.end();
  }
};

void bind_tick(nb::module_& module) {
  nb::class_<Tick>(module, "Tick", "A run between two ticks; it ends with the run.")
      .def("__repr__",
           [](const Tick& self) {
             return self.plant.has_ended() ? std::string("<tick of a run that has ended>")
                                           : formatted("<tick at %.4f s>", self.plant->time());
           })
      .def_prop_ro(
          "time", [](const Tick& self) { return self.plant->time(); }, "[s]")
      .def_prop_ro(
          "plant", [](Tick& self) -> BoundPlant& { return self.plant; },
          nb::rv_policy::reference_internal, "as it is before the tick")
      .def_prop_ro(
          "controller", [](Tick& self) -> BoundController& { return self.controller; },
          nb::rv_policy::reference_internal, "as it was after the tick before")
      .def_rw("user", &Tick::user, "the scenario's command; write another into it")
      .def("stop", [](Tick& self) { self.stops = true; }, "Ends the run before this tick.");
}

/// Calls Python between the ticks of a run, and logs what it changes.
class TickHook final : public closed_loop::RunSteering {
 public:
  TickHook(const config::Scenario& scenario, nb::callable every_tick)
      : scenario_(scenario), every_tick_(std::move(every_tick)) {}
  TickHook(const TickHook&) = delete;
  TickHook& operator=(const TickHook&) = delete;
  ~TickHook() override {
    const Interpreter::Locked python;
    if (tick_.is_valid()) nb::cast<Tick&>(tick_).end();
  }

  void begin(const closed_loop::RunParts& parts) override {
    const Interpreter::Locked python;
    tick_ = nb::cast(Tick{{scenario_, parts.plant}, {scenario_, parts.controller}, {}});
    nb::cast<Tick&>(tick_).resume();
    log_change_ = parts.log_change;
  }
  closed_loop::RunOrder before_tick(double time) override {
    const Interpreter::Locked python;
    Tick& tick = nb::cast<Tick&>(tick_);
    tick.user = scenario_.user(time);
    tick.pause();
    try {
      every_tick_(tick_);
      user_ = tick.controller.checked(tick.user);
    } catch (...) {
      error_ = std::current_exception();
    }
    tick.resume();  // after changes of other threads, which this tick has, too
    tick.plant.changes.take(time, 0, log_change_);
    tick.controller.changes.take(time, 0, log_change_);
    return error_ || tick.stops ? closed_loop::RunOrder::stop : closed_loop::RunOrder::tick;
  }
  UserCommand user(const UserCommand&) override { return user_; }
  void after_tick(const TickRecord&, const simulation::GroundTruth&, const TickTiming&) override {}

  /// With the lock: what the callback raised.
  void raise() {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  const config::Scenario& scenario_;
  nb::callable every_tick_;
  nb::object tick_;
  std::function<void(const logged::Change&)> log_change_;
  UserCommand user_;
  std::exception_ptr error_;
};

Result run(const config::Scenario& scenario, const std::optional<std::string>& record,
           const std::optional<nb::callable>& every_tick, const nb::object& estimator,
           const nb::object& planner) {
  Interrupt interrupt;
  std::optional<TickHook> hook;
  if (every_tick) hook.emplace(scenario, *every_tick);
  closed_loop::ClosedLoopOptions options;
  if (record && record->empty())
    throw Error("record is an empty text; the path of a log to write, run.mcap, would be valid");
  options.record_path = record.value_or("");
  options.interrupted = [&] { return interrupt.is_asked(); };
  if (!estimator.is_none())
    options.make_estimator = [&, shared = SharedObject(estimator)] {
      return own_estimator(shared, scenario.robot);
    };
  if (!planner.is_none())
    options.make_planner = [&, shared = SharedObject(planner)] {
      return own_planner(shared, scenario.robot);
    };
  options.steering = hook ? &*hook : nullptr;
  closed_loop::RunResult run;
  {
    const Interpreter::Unlocked others_may_run;
    run = closed_loop::run_closed_loop(scenario, options);
  }
  interrupt.raise();
  if (hook) hook->raise();
  if (!run.fault.empty())
    if (PyErr_WarnEx(PyExc_RuntimeWarning, run.fault.c_str(), 4) != 0) throw nb::python_error();
  return {scenario.name,    record,    run.metrics, run.criteria,
          event_lines(run), run.notes, run.fault,   run.torques_hash};
}

}  // namespace

void bind_running(nb::module_& module) {
  bind_result(module);
  bind_tick(module);
  module.def(
      "run_scenario", &run, nb::arg("scenario"), nb::arg("record"), nb::arg("every_tick"),
      nb::arg("estimator") = nb::none(), nb::arg("planner") = nb::none(),
      nb::sig("def run_scenario(scenario: Scenario, record: str | None, every_tick: "
              "typing.Callable[[Tick], None] | None, estimator: Estimator | None = None, planner: "
              "Planner | None = None) -> Result"),
      "As `surefoot.run` does.");
}

}  // namespace surefoot::python
