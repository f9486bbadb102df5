#pragma once

#include <nanobind/nanobind.h>

namespace surefoot::python {

namespace nb = nanobind;

/// For a class with a constructor: Python's own way to call it, so that surefoot/_arguments.py can
/// stand before `__init__` and say what is wrong with an argument.
inline int no_constructor(PyObject* self, PyObject*, PyObject*) {
  const nb::object name = nb::handle(self).type().attr("__name__");
  PyErr_Format(PyExc_TypeError, "%U objects are made by the library, not by hand", name.ptr());
  return -1;
}
inline PyType_Slot kNoVectorcall[] = {{Py_tp_init, reinterpret_cast<void*>(&no_constructor)},
                                      {0, nullptr}};

// Each adds its classes and functions to the module.
void bind_signals(nb::module_& module);
void bind_level(nb::module_& module);
void bind_robot(nb::module_& module);
void bind_doctor(nb::module_& module);
void bind_stack(nb::module_& module);
void bind_scenario(nb::module_& module);
void bind_plant(nb::module_& module);
void bind_estimator(nb::module_& module);
void bind_planner(nb::module_& module);
void bind_task_tick(nb::module_& module);
void bind_gait_tick(nb::module_& module);
void bind_gait(nb::module_& module);
void bind_controller(nb::module_& module);
void bind_running(nb::module_& module);
void bind_evaluation(nb::module_& module);
void bind_recording(nb::module_& module);
void bind_replaying(nb::module_& module);
void bind_explaining(nb::module_& module);
void bind_solving(nb::module_& module);

}  // namespace surefoot::python
