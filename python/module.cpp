// The compiled part of the Python package `surefoot`, under the names of C++.

#include "python/bindings.hpp"
#include "python/interpreter.hpp"
#include "surefoot/base/build_info.hpp"
#include "surefoot/base/error.hpp"

#include <nanobind/stl/string_view.h>

namespace surefoot::python {
namespace {

/// The same hierarchy, with the same messages. What was raised last is caught first.
void bind_errors(nb::module_& module) {
  const nb::exception<Error> error(module, "Error", PyExc_ValueError);
  const nb::exception<FileError> file_error(module, "FileError", error.ptr());
  const nb::exception<UnknownNameError> name_error(module, "UnknownNameError", error.ptr());
}

}  // namespace

NB_MODULE(_core, module) {
  module.doc() =
      "Whole-body control of legged robots by strict task hierarchies.\n\n"
      "Units are SI. Frames stand in the names: p_WB is the position of the base B in the "
      "controller's "
      "world W, p_SB the true one in the simulator's world S.\n"
      "Arrays look into the object that they come from; objects are snapshots and don't change.";
  module.attr("__version__") = build_info().version;
  // Parts of the user's own may refer back to what holds them, which no collector sees at exit.
  nb::set_leak_warnings(false);
  nb::module_::import_("atexit").attr("register")(nb::cpp_function(&Interpreter::end));
  bind_errors(module);
  bind_signals(module);
  bind_level(module);
  bind_robot(module);
  bind_doctor(module);
  bind_stack(module);
  bind_scenario(module);
  bind_plant(module);
  bind_estimator(module);
  bind_planner(module);
  bind_task_tick(module);
  bind_gait_tick(module);
  bind_gait(module);
  bind_controller(module);
  bind_evaluation(module);
  bind_recording(module);
  bind_running(module);
  bind_replaying(module);
  bind_explaining(module);
  bind_solving(module);
}

}  // namespace surefoot::python
