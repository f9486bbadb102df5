#pragma once

#include <nanobind/nanobind.h>

namespace surefoot::python {

namespace nb = nanobind;

// Each adds its classes and functions to the module.
void bind_signals(nb::module_& module);
void bind_level(nb::module_& module);
void bind_robot(nb::module_& module);
void bind_doctor(nb::module_& module);
void bind_stack(nb::module_& module);
void bind_scenario(nb::module_& module);
void bind_plant(nb::module_& module);
void bind_parts(nb::module_& module);
void bind_controller(nb::module_& module);
void bind_evaluation(nb::module_& module);
void bind_explaining(nb::module_& module);
void bind_solving(nb::module_& module);

}  // namespace surefoot::python
