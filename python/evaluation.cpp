// Whole runs, and the judging of runs by hand.

#include "python/bindings.hpp"
#include "python/controller.hpp"
#include "python/interrupt.hpp"
#include "python/numbers.hpp"
#include "python/parts.hpp"
#include "surefoot/base/build_info.hpp"
#include "surefoot/base/formatted.hpp"
#include "surefoot/closed_loop/closed_loop.hpp"
#include "surefoot/closed_loop/goal_watch.hpp"
#include "surefoot/closed_loop/run_log.hpp"
#include "surefoot/evaluation/alignment.hpp"
#include "surefoot/evaluation/evaluator.hpp"
#include "surefoot/evaluation/truth_log.hpp"
#include "surefoot/logging/recorder.hpp"
#include "surefoot/simulation/plant.hpp"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/vector.h>

#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace surefoot::python {
namespace {

using evaluation::CriterionResult;

nb::object as_object(const evaluation::MetricValue& value) {
  return std::visit(
      [](const auto& given) -> nb::object {
        using T = std::decay_t<decltype(given)>;
        if constexpr (std::is_same_v<T, evaluation::Quantiles>) {
          nb::dict quantiles;
          quantiles["median"] = given.median;
          quantiles["p99"] = given.p99;
          quantiles["max"] = given.max;
          return quantiles;
        } else if constexpr (std::is_same_v<T, std::optional<bool>>) {
          return given ? nb::object(nb::bool_(*given)) : nb::none();
        } else {
          return nb::cast(given);
        }
      },
      value);
}

using Metrics = nb::typed<nb::dict, std::string, nb::any>;

Metrics as_dict(const evaluation::Metrics& metrics) {
  Metrics result;
  for (const auto& [name, value] : values(metrics)) result[nb::cast(name)] = as_object(value);
  return result;
}

std::string limits(const evaluation::Criterion& criterion) {
  if (criterion.equals) return *criterion.equals ? "is true" : "is false";
  std::string text;
  if (criterion.min) text = formatted("at least %g", *criterion.min);
  if (criterion.max)
    text += (text.empty() ? "" : " and ") + formatted("at most %g", *criterion.max);
  return text;
}

void bind_criterion(nb::module_& module) {
  nb::class_<CriterionResult>(module, "Criterion", "A limit on a metric, and whether it held.")
      .def_prop_ro("metric", [](const CriterionResult& self) { return self.criterion.metric; })
      .def_prop_ro("limits", [](const CriterionResult& self) { return limits(self.criterion); })
      .def_ro("value", &CriterionResult::value, "of the metric; 1 and 0 for true and false")
      .def_ro("passed", &CriterionResult::passed, "None: not judged, as the run was too short")
      .def("__repr__", [](const CriterionResult& self) {
        return "<" + self.criterion.metric + " " + limits(self.criterion) +
               (!self.passed   ? ": not judged, "
                : *self.passed ? ": passed, "
                               : ": missed, ") +
               formatted("%.4g", self.value) + ">";
      });
}

/// `Result` in Python.
struct Result {
  std::string scenario;
  closed_loop::RunResult run;
  std::optional<std::string> log;
};

std::vector<std::string> events(const Result& self) {
  std::vector<std::string> lines;
  for (const evaluation::EventCount& each : self.run.events)
    lines.push_back(std::string(name(each.event)) +
                    formatted(": %d, first at %.4f s", each.count, each.first));
  for (const closed_loop::TroubleCount& each : self.run.troubles)
    lines.push_back(each.what + formatted(": %d, first at %.4f s", each.count, each.first));
  return lines;
}

void bind_result(nb::module_& module) {
  bind_criterion(module);
  using Self = Result;
  nb::class_<Self>(module, "Result", "How a run went.")
      .def_prop_ro(
          "succeeded", [](const Self& self) { return self.run.metrics.succeeded; },
          "all criteria held, and the controller did not stop; None: not judged")
      .def_prop_ro(
          "reason", [](const Self& self) { return self.run.metrics.reason; }, "why it ended")
      .def_prop_ro(
          "metrics", [](const Self& self) { return as_dict(self.run.metrics); },
          nb::sig("def metrics(self) -> dict[str, typing.Any]"),
          "by name, each with its unit in it; NaN: not measured")
      .def_prop_ro("criteria", [](const Self& self) { return self.run.criteria; })
      .def_prop_ro("events", &events, "notable ones, and faults: a line each")
      .def_prop_ro("notes", [](const Self& self) { return self.run.notes; })
      .def_prop_ro(
          "torques_hash", [](const Self& self) { return self.run.torques_hash; },
          "of all commanded torques: equal for runs that are equal to the bit")
      .def_ro("log", &Self::log, "its path, if it was recorded")
      .def(
          "__getitem__",
          [](const Self& self, const std::string& metric) {
            const Metrics metrics = as_dict(self.run.metrics);
            if (!metrics.contains(metric.c_str()))
              throw nb::key_error((metric + "; `.metrics` has all names").c_str());
            return nb::object(metrics[metric.c_str()]);
          },
          nb::sig("def __getitem__(self, metric: str) -> typing.Any"))
      .def("__repr__", [](const Self& self) {
        std::string missed;
        for (const CriterionResult& each : self.run.criteria)
          if (each.passed == false)
            missed += (missed.empty() ? "; missed: " : ", ") + each.criterion.metric;
        return "<run of " + self.scenario +
               (!self.run.metrics.succeeded   ? ", not judged"
                : *self.run.metrics.succeeded ? ", succeeded"
                                              : ", did not succeed") +
               formatted(", %.4g s: ", self.run.metrics.duration_s) + self.run.metrics.reason +
               missed + ">";
      });
}

/// What a run's callback is given before each tick; `Tick` in Python.
struct Tick {
  simulation::Plant* plant;  // null: the run has ended
  BoundController controller;
  UserCommand user;
  bool stops = false;
};

Tick& in_run(Tick& tick) {
  if (tick.plant == nullptr) throw Error("the run of this tick has ended");
  return tick;
}

void bind_tick(nb::module_& module) {
  nb::class_<Tick>(module, "Tick", "A run between two ticks; it ends with the run.")
      .def("__repr__",
           [](Tick& self) {
             return self.plant == nullptr ? std::string("<tick of a run that has ended>")
                                          : formatted("<tick at %.4f s>", self.plant->time());
           })
      .def_prop_ro(
          "time", [](Tick& self) { return in_run(self).plant->time(); }, "[s]")
      .def_prop_ro(
          "plant", [](Tick& self) -> simulation::Plant& { return *in_run(self).plant; },
          nb::rv_policy::reference_internal)
      .def_prop_ro(
          "controller", [](Tick& self) -> BoundController& { return in_run(self).controller; },
          nb::rv_policy::reference_internal, "as it was after the tick before")
      .def_rw("user", &Tick::user, "the scenario's command; write another into it")
      .def("stop", [](Tick& self) { self.stops = true; }, "Ends the run before this tick.");
}

/// Calls Python between the ticks of a run.
class TickHook final : public closed_loop::RunSteering {
 public:
  TickHook(const config::Scenario& scenario, nb::callable every_tick)
      : scenario_(scenario), every_tick_(std::move(every_tick)) {}
  TickHook(const TickHook&) = delete;
  TickHook& operator=(const TickHook&) = delete;
  ~TickHook() override {
    const nb::gil_scoped_acquire python;
    if (tick_.is_valid()) nb::cast<Tick&>(tick_).plant = nullptr;
  }

  void begin(const closed_loop::RunParts& parts) override {
    const nb::gil_scoped_acquire python;
    tick_ = nb::cast(Tick{&parts.plant, BoundController(scenario_.robot, parts.controller), {}});
  }
  closed_loop::RunOrder before_tick(double time) override {
    const nb::gil_scoped_acquire python;
    Tick& tick = nb::cast<Tick&>(tick_);
    tick.user = scenario_.user(time);
    try {
      every_tick_(tick_);
    } catch (nb::python_error& error) {
      error_.emplace(std::move(error));
    }
    return error_ || tick.stops ? closed_loop::RunOrder::stop : closed_loop::RunOrder::tick;
  }
  UserCommand user(const UserCommand&) override {
    const nb::gil_scoped_acquire python;
    return nb::cast<Tick&>(tick_).user;
  }
  void after_tick(const TickRecord&, const simulation::GroundTruth&, const TickTiming&) override {}

  /// With the lock: what the callback raised.
  void raise() {
    if (error_) throw std::move(*error_);
  }

 private:
  const config::Scenario& scenario_;
  nb::callable every_tick_;
  nb::object tick_;
  std::optional<nb::python_error> error_;
};

Result run(const config::Scenario& scenario, const std::optional<std::string>& record,
           const std::optional<nb::callable>& every_tick, const nb::object& estimator,
           const nb::object& planner) {
  Interrupt interrupt;
  std::optional<TickHook> hook;
  if (every_tick) hook.emplace(scenario, *every_tick);
  closed_loop::ClosedLoopOptions options;
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
  Result result{scenario.name, {}, record};
  {
    const nb::gil_scoped_release others_may_run;
    result.run = closed_loop::run_closed_loop(scenario, options);
  }
  interrupt.raise();
  if (hook) hook->raise();
  return result;
}

/// Judges, and on request records, a run that is stepped by hand; `Evaluator` in Python.
class HandEvaluator {
 public:
  HandEvaluator(const config::Scenario& scenario, simulation::Plant& plant,
                BoundController& controller, const std::optional<std::string>& record)
      : scenario_(scenario),
        plant_(plant),
        controller_(controller),
        model_(scenario.robot),
        goal_(scenario.goal),
        evaluator_(
            {.control_period = scenario.controller.period,
             .mass = model_.mass(),
             .scale = scenario.robot.scale,
             .terrain_height = [&](double x, double y) { return plant.terrain_height(x, y); },
             .hip_in_base = hips()}) {
    controller->explain_levels(record.has_value());
    if (!record) return;
    recorder_.emplace(*record, closed_loop::log_header(scenario, *controller, plant, model_));
    truth_log_.emplace(*recorder_);
  }

  void add() {
    const TickRecord& record = controller_->record();
    if (!(std::abs(record.reading.time - plant_.time()) <= kTimeRounding))
      throw Error(
          formatted("the controller is at %g s, the plant at %g s; add() comes after step() "
                    "and before write()",
                    record.reading.time, plant_.time()));
    evaluator_.add(plant_.truth(), record);
    TickTiming timing = controller_.timing();
    timing.time = plant_.time();
    evaluator_.add(timing);
    (void)goal_.update(plant_.truth());
    if (!recorder_) return;
    recorder_->record(record);
    recorder_->record(timing);
    truth_log_->record(plant_.truth(), record);
  }

  [[nodiscard]] evaluation::Metrics metrics() const {
    evaluation::Metrics metrics = evaluator_.metrics({.reason = "stepped by hand",
                                                      .seed = scenario_.seed,
                                                      .version = std::string(build_info().version),
                                                      .goal_reached = goal_.reached()});
    metrics.succeeded = evaluation::all_passed(criteria(metrics));
    return metrics;
  }
  [[nodiscard]] std::vector<CriterionResult> criteria(const evaluation::Metrics& metrics) const {
    const bool is_short = metrics.duration_s < scenario_.judged_after - 1e-9;
    return evaluation::evaluate(scenario_.criteria, metrics,
                                is_short ? evaluation::Extent::part : evaluation::Extent::whole);
  }
  void close() {
    if (!recorder_) return;
    const evaluation::Metrics found = metrics();
    recorder_->close(evaluation::summary_json(found, criteria(found)));
    truth_log_.reset();
    recorder_.reset();
  }
  [[nodiscard]] bool fell() const { return evaluator_.fell(); }

 private:
  /// Of a robot that only stands legs may be of any kind.
  [[nodiscard]] std::function<Vec3(Leg, const Vec3&)> hips() const {
    if (!scenario_.robot.can_walk()) return nullptr;
    return [this](Leg leg, const Vec3& q) { return model_.hip_in_base(leg, q); };
  }

  const config::Scenario& scenario_;
  simulation::Plant& plant_;
  BoundController& controller_;
  model::RobotModel model_;
  closed_loop::GoalWatch goal_;
  evaluation::Evaluator evaluator_;
  std::optional<logging::Recorder> recorder_;
  std::optional<evaluation::TruthLog> truth_log_;
};

void bind_evaluator(nb::module_& module) {
  using Self = HandEvaluator;
  nb::class_<Self>(module, "Evaluator",
                   "Judges a run that you step yourself, on the plant's truth, and records it.\n\n"
                   "    while plant.time < scenario.duration:\n"
                   "        command = controller.step(plant.read(), scenario.user(plant.time))\n"
                   "        evaluator.add()\n"
                   "        plant.write(command)\n"
                   "    evaluator.close()")
      .def(nb::init<const config::Scenario&, simulation::Plant&, BoundController&,
                    const std::optional<std::string>&>(),
           nb::arg("scenario"), nb::arg("plant"), nb::arg("controller"),
           nb::arg("record") = nb::none(), nb::keep_alive<1, 2>(), nb::keep_alive<1, 3>(),
           nb::keep_alive<1, 4>(), "record: path of a log to write, run.mcap.")
      .def("add", &Self::add, nb::call_guard<nb::gil_scoped_release>(),
           "A tick: after step(), before write().")
      .def_prop_ro(
          "metrics", [](const Self& self) { return as_dict(self.metrics()); },
          nb::sig("def metrics(self) -> dict[str, typing.Any]"))
      .def_prop_ro(
          "criteria", [](const Self& self) { return self.criteria(self.metrics()); },
          "of the scenario")
      .def_prop_ro("fell", &Self::fell)
      .def("close", &Self::close, "Completes the log.");
}

void bind_aligner(nb::module_& module) {
  nb::class_<evaluation::Aligner>(
      module, "Aligner",
      "Compares a plant's truth, in S, with its controller's plan and estimate, in W. The two\n"
      "worlds lie elsewhere and drift apart: never subtract their numbers.")
      .def(nb::init<>())
      .def(
          "update",
          [](evaluation::Aligner& self, const simulation::Plant& plant, const BoundController& of) {
            return self.update(plant.truth(), of->record());
          },
          nb::arg("plant"), nb::arg("controller"),
          "The alignment and its errors after a tick: call it at every tick, from the first on,\n"
          "between controller.step() and plant.write().");
}

}  // namespace

void bind_evaluation(nb::module_& module) {
  bind_result(module);
  bind_tick(module);
  bind_evaluator(module);
  bind_aligner(module);
  module.def(
      "run_scenario", &run, nb::arg("scenario"), nb::arg("record"), nb::arg("every_tick"),
      nb::arg("estimator") = nb::none(), nb::arg("planner") = nb::none(),
      nb::sig("def run_scenario(scenario: Scenario, record: str | None, every_tick: "
              "typing.Callable[[Tick], None] | None, estimator: Estimator | None = None, planner: "
              "Planner | None = None) -> Result"),
      "As `surefoot.run` does.");
}

}  // namespace surefoot::python
