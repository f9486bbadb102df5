#pragma once

#include "python/controller.hpp"
#include "python/plant.hpp"
#include "surefoot/base/formatted.hpp"
#include "surefoot/closed_loop/change_log.hpp"
#include "surefoot/closed_loop/run_log.hpp"
#include "surefoot/evaluation/truth_log.hpp"
#include "surefoot/logging/clock_text.hpp"
#include "surefoot/logging/recorder.hpp"

#include <optional>
#include <string>
#include <string_view>

namespace surefoot::python {

/// The log of a loop that is stepped by hand, with the truth of its plant if it has one.
class HandLog {
 public:
  /// `plant`: may be null. Throws Error after the first tick, and while another log records either.
  HandLog(const std::string& path, const config::Scenario& scenario, BoundController& controller,
          BoundPlant* plant, const model::RobotModel& model)
      : controller_(controller),
        plant_(plant),
        recorder_(checked(path, controller, plant),
                  closed_loop::log_header(scenario, *controller,
                                          plant == nullptr ? nullptr : &**plant, model)) {
    if (plant_ != nullptr) truth_log_.emplace(recorder_);
    change_log_.emplace(recorder_);
    controller_->explain_levels(true);
    set_recorded(true);
  }
  HandLog(const HandLog&) = delete;
  HandLog& operator=(const HandLog&) = delete;
  ~HandLog() { set_recorded(false); }

  /// The last tick, after it and before the next change. Throws Error if there is none, and if its
  /// time does not grow.
  void add() {
    const TickRecord& record = controller_->record();
    const double time = record.reading.time;
    const long missing = begin_tick(logging::to_nanosecond(time));
    const auto log = [&](const logged::Change& change) {
      change_log_->record(change, *controller_);
    };
    if (plant_ != nullptr) plant_->changes.take(time, 0, log);
    controller_.changes.take(time, controller_.ticks() - 1, log);
    recorder_.record(record);
    recorder_.record(controller_.timing());
    if (truth_log_) truth_log_->record((*plant_)->truth(), record);
    if (missing > 0) warn(missing);
  }

  void close(std::string_view summary) { recorder_.close(summary); }

 private:
  static const std::string& checked(const std::string& path, const BoundController& controller,
                                    const BoundPlant* plant) {
    if (controller.ticks() > 0)
      throw Error("record: the controller has made " + std::to_string(controller.ticks()) +
                  " ticks already, and a log begins with the first; one that is made before step() "
                  "would be valid");
    if (controller.changes.is_recorded() || (plant != nullptr && plant->changes.is_recorded()))
      throw Error("record: another log records this plant or controller; close() it first");
    return path;
  }
  /// How many ticks before this one are not in the log.
  [[nodiscard]] long begin_tick(double time) {
    const long missing = controller_.ticks() - ticks_ - 1;
    if (missing < 0)
      throw Error("the controller has made no tick since the last add(), which comes after step()");
    if (!(time > time_))
      throw Error(formatted("the reading's time is %g s", time) +
                  (ticks_ == 0 ? "" : formatted(", and the one before was at %g s", time_)) +
                  "; times that grow from 0 on would be valid");
    time_ = time;
    ticks_ = controller_.ticks();
    return missing;
  }
  static void warn(long missing) {
    const std::string told = std::to_string(missing) + (missing == 1 ? " tick is" : " ticks are") +
                             " not in the log, and what comes behind can't be computed again; "
                             "add() after each step() would be valid";
    if (PyErr_WarnEx(PyExc_RuntimeWarning, told.c_str(), 2) != 0) throw nb::python_error();
  }
  void set_recorded(bool recorded) {
    if (plant_ != nullptr) plant_->changes.set_recorded(recorded);
    controller_.changes.set_recorded(recorded);
  }

  BoundController& controller_;
  BoundPlant* plant_;
  double time_ = -1e-12;  // of the last tick [s]
  long ticks_ = 0;        // of the controller, then
  logging::Recorder recorder_;
  std::optional<evaluation::TruthLog> truth_log_;
  std::optional<closed_loop::ChangeLog> change_log_;
};

}  // namespace surefoot::python
