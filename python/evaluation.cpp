// The judging of runs by hand.

#include "python/bindings.hpp"
#include "python/hand_log.hpp"
#include "python/metrics.hpp"
#include "surefoot/base/build_info.hpp"
#include "surefoot/base/formatted.hpp"
#include "surefoot/closed_loop/goal_watch.hpp"
#include "surefoot/closed_loop/stop_watch.hpp"
#include "surefoot/evaluation/alignment.hpp"
#include "surefoot/evaluation/evaluator.hpp"

#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

namespace surefoot::python {
namespace {

using evaluation::CriterionResult;

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
      .def_prop_ro(
          "metric", [](const CriterionResult& self) { return self.criterion.metric; }, "its name")
      .def_prop_ro(
          "limits", [](const CriterionResult& self) { return limits(self.criterion); }, "in words")
      .def_ro("value", &CriterionResult::value, "of the metric; 1 and 0 for true and false")
      .def_ro("passed", &CriterionResult::passed, "None: not judged, as the run was too short")
      .def("__getstate__",
           [](const CriterionResult& self) {
             const auto& [metric, min, max, equals] = self.criterion;
             return std::make_tuple(metric, min, max, equals, self.value, self.passed);
           })
      .def("__setstate__",
           [](CriterionResult& self,
              const std::tuple<std::string, std::optional<double>, std::optional<double>,
                               std::optional<bool>, double, std::optional<bool>>& state) {
             const auto& [metric, min, max, equals, value, passed] = state;
             new (&self) CriterionResult{{metric, min, max, equals}, value, passed};
           })
      .def("__repr__", [](const CriterionResult& self) {
        return "<" + self.criterion.metric + " " + limits(self.criterion) +
               (!self.passed   ? ": not judged, "
                : *self.passed ? ": passed, "
                               : ": missed, ") +
               formatted("%.4g", self.value) + ">";
      });
}

/// Judges, and on request records, a run that is stepped by hand; `Evaluator` in Python.
class HandEvaluator {
 public:
  HandEvaluator(const config::Scenario& scenario, BoundPlant& plant, BoundController& controller,
                const std::optional<std::filesystem::path>& record)
      : scenario_(scenario),
        plant_(plant),
        controller_(controller),
        model_(scenario.robot),
        goal_(scenario.goal),
        evaluator_(
            {.control_period = scenario.controller.period,
             .mass = model_.mass(),
             .scale = scenario.robot.scale,
             .terrain_height = [&](double x, double y) { return plant->terrain_height(x, y); },
             .hip_in_base = hips()}),
        stop_(scenario.robot) {
    plant.check_controller_of(controller.robot().name);
    if (controller.robot().name != scenario.robot.name)
      throw Error("scenario is of " + scenario.robot.name + ", and the controller of " +
                  controller.robot().name);
    if (record)
      log_ = std::make_unique<HandLog>(record->string(), scenario, controller, &plant, model_);
  }

  void add() {
    const TickRecord& record = controller_->record();
    const double time = plant_->time();
    if (!(std::abs(record.reading.time - time) <= kTimeRounding))
      throw Error(
          formatted("the controller is at %g s, the plant at %g s; add() comes after step() "
                    "and before write()",
                    record.reading.time, time));
    if (log_) log_->add();
    evaluator_.add(plant_->truth(), record);
    evaluator_.add(controller_.timing());
    if (!evaluator_.fell()) stop_.update(*controller_, time);
    (void)goal_.update(plant_->truth());
  }

  [[nodiscard]] evaluation::Metrics metrics() const {
    evaluation::Metrics metrics = evaluator_.metrics({.reason = reason(),
                                                      .seed = scenario_.seed,
                                                      .version = std::string(build_info().version),
                                                      .goal_reached = goal_.reached()});
    metrics.succeeded = evaluation::all_passed(criteria(metrics));
    if (stop_.has_stopped() || !controller_->fault().empty()) metrics.succeeded = false;
    return metrics;
  }
  [[nodiscard]] std::vector<CriterionResult> criteria(const evaluation::Metrics& metrics) const {
    const bool has_ended = evaluator_.fell() || stop_.has_stopped() || goal_.reached() == true;
    // A loop by hand may stop before the scenario does.
    const double needed =
        std::isnan(scenario_.judged_after) ? scenario_.duration : scenario_.judged_after;
    const bool is_short = !has_ended && metrics.duration_s < needed - 1e-9;
    return evaluation::evaluate(scenario_.criteria, metrics,
                                is_short ? evaluation::Extent::part : evaluation::Extent::whole);
  }
  /// So far.
  [[nodiscard]] std::string reason() const {
    if (stop_.has_stopped()) return stop_.reason(evaluator_.fall());
    return closed_loop::with_fault(evaluator_.fell() ? evaluator_.fall() : "stepped by hand",
                                   controller_->fault());
  }
  void close() {
    if (!log_) return;
    const evaluation::Metrics found = metrics();
    log_->close(evaluation::summary_json(found, criteria(found)));
    log_.reset();
  }
  [[nodiscard]] bool fell() const { return evaluator_.fell(); }

 private:
  /// Of a robot that only stands legs may be of any kind.
  [[nodiscard]] std::function<Vec3(Leg, const Vec3&)> hips() const {
    if (!scenario_.robot.can_walk()) return nullptr;
    return [this](Leg leg, const Vec3& q) { return model_.hip_in_base(leg, q); };
  }

  const config::Scenario& scenario_;
  BoundPlant& plant_;
  BoundController& controller_;
  model::RobotModel model_;
  closed_loop::GoalWatch goal_;
  evaluation::Evaluator evaluator_;
  closed_loop::StopWatch stop_;
  std::unique_ptr<HandLog> log_;
};

void bind_evaluator(nb::module_& module) {
  using Self = HandEvaluator;
  nb::class_<Self>(module, "Evaluator",
                   "Judges a run that you step yourself, on the plant's truth, and records it.\n\n"
                   "    while plant.time < scenario.duration:\n"
                   "        command = controller.step(plant.read(), scenario.user(plant.time))\n"
                   "        evaluator.add()\n"
                   "        plant.write(command)\n"
                   "    evaluator.close()\n\n"
                   "The log has what is changed between two ticks, so it can be replayed.",
                   nb::type_slots(kNoVectorcall))
      .def(nb::init<const config::Scenario&, BoundPlant&, BoundController&,
                    const std::optional<std::filesystem::path>&>(),
           nb::arg("scenario"), nb::arg("plant"), nb::arg("controller"),
           nb::arg("record") = nb::none(),
           nb::sig("def __init__(self, scenario: Scenario, plant: Plant, controller: "
                   "ControllerBase, record: str | os.PathLike[str] | None = None) -> None"),
           nb::keep_alive<1, 2>(), nb::keep_alive<1, 3>(), nb::keep_alive<1, 4>(),
           "record: path of a log to write, run.mcap.")
      .def("add", &Self::add, "A tick: after step(), before write().")
      .def_prop_ro(
          "metrics", [](const Self& self) { return as_dict(self.metrics()); },
          nb::sig("def metrics(self) -> dict[str, typing.Any]"),
          "so far, by name; `surefoot list metrics` says what they are")
      .def_prop_ro(
          "criteria", [](const Self& self) { return self.criteria(self.metrics()); },
          "of the scenario")
      .def_prop_ro("fell", &Self::fell, "so far")
      .def_prop_ro(
          "succeeded", [](const Self& self) { return self.metrics().succeeded; },
          "so far: all criteria hold, the controller has not stopped, and no part of your own has "
          "failed; None: not judged yet")
      .def_prop_ro("reason", &Self::reason, "why it stopped for safety, or fell")
      .def("close", &Self::close, "Completes the log.");
}

/// `Aligner` in Python.
struct BoundAligner {
  evaluation::Aligner aligner;
  bool has_begun = false;
};

void bind_aligner(nb::module_& module) {
  nb::class_<BoundAligner>(
      module, "Aligner",
      "Compares a plant's truth, in S, with its controller's plan and estimate, in W. The two\n"
      "worlds lie elsewhere and drift apart: never subtract their numbers.",
      nb::type_slots(kNoVectorcall))
      .def(nb::init<>())
      .def(
          "update",
          [](BoundAligner& self, const BoundPlant& plant, const BoundController& of) {
            plant.check_controller_of(of.robot().name);
            if (!self.has_begun && plant->time() > kTimeRounding)
              throw Error(
                  formatted("the run is at %g s already; an Aligner that is updated from the first "
                            "tick on knows where the worlds lie",
                            plant->time()));
            self.has_begun = true;
            return self.aligner.update(plant->truth(), of->record());
          },
          nb::arg("plant"), nb::arg("controller"),
          "The alignment and its errors after a tick: call it at every tick, from the first on,\n"
          "between controller.step() and plant.write().");
}

}  // namespace

void bind_evaluation(nb::module_& module) {
  bind_criterion(module);
  bind_evaluator(module);
  bind_aligner(module);
}

}  // namespace surefoot::python
