// Logs of loops by hand.

#include "python/bindings.hpp"
#include "python/hand_log.hpp"

#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/string.h>

#include <filesystem>
#include <memory>
#include <string>

namespace surefoot::python {
namespace {

/// `Recorder` in Python.
class HandRecorder {
 public:
  HandRecorder(BoundController& controller, const config::Scenario& scenario,
               const std::string& path)
      : controller_(controller),
        path_(path),
        log_(std::make_unique<HandLog>(path, scenario, controller, nullptr,
                                       model::RobotModel(scenario.robot))) {}

  void add() {
    if (!log_) throw Error("this Recorder is closed; another one, of another log, would be valid");
    log_->add();
  }
  void close() {
    if (log_) log_->close("{}");
    log_.reset();
  }
  [[nodiscard]] std::string shown() const {
    return "<recorder of " + path_ + (log_ ? ">" : ", closed>");
  }

 private:
  BoundController& controller_;
  std::string path_;
  std::unique_ptr<HandLog> log_;
};

}  // namespace

void bind_recording(nb::module_& module) {
  using Self = HandRecorder;
  nb::class_<Self>(module, "Recorder",
                   "Records a controller that you step yourself on readings from anywhere, as from "
                   "a real robot.\n\n"
                   "    with surefoot.Recorder(controller, \"run.mcap\") as recorder:\n"
                   "        while …:\n"
                   "            command = controller.step(reading, user)\n"
                   "            recorder.add()\n\n"
                   "The log has no truth. An Evaluator records a loop with a Plant.",
                   nb::type_slots(kNoVectorcall))
      .def(
          "__init__",
          [](Self* self, nb::handle_t<BoundController> controller,
             const std::filesystem::path& path) {
            if (!nb::hasattr(controller, "scenario"))
              throw Error(
                  "controller is that of a run; surefoot.run(…, record=\"run.mcap\") would "
                  "be valid");
            new (self)
                Self(nb::cast<BoundController&>(controller),
                     nb::cast<const config::Scenario&>(controller.attr("scenario")), path.string());
          },
          nb::arg("controller"), nb::arg("path"), nb::keep_alive<1, 2>(),
          nb::sig("def __init__(self, controller: ControllerBase, path: str | os.PathLike[str]) -> "
                  "None"),
          "path: of the log to write, run.mcap.")
      .def("__repr__", &Self::shown)
      .def("add", &Self::add,
           "A tick: after step(). Warns of ticks that were not added. Raises Error where the "
           "reading's time does not grow.")
      .def("close", &Self::close, "Completes the log; without it, it is called run.mcap.partial.")
      .def(
          "__enter__", [](nb::handle_t<Self> self) { return nb::borrow(self); },
          nb::sig("def __enter__(self) -> Recorder"))
      .def(
          "__exit__", [](Self& self, const nb::args&) { self.close(); },
          nb::sig("def __exit__(self, *error: object) -> None"));
}

}  // namespace surefoot::python
