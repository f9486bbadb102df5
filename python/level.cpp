#include "python/bindings.hpp"
#include "python/level_outcome.hpp"

namespace surefoot::python {

void bind_level(nb::module_& module) {
  using Self = LevelOutcome;
  nb::class_<Self>(module, "Level", "How one level of a hierarchy came out.")
      .def_ro("name", &Self::name, "in its stack or problem")
      .def_prop_ro(
          "residual", [](const Self& self) { return self.report.residual; },
          "√Σ violation² over its rows, in their unit; so far, where the search ended in this "
          "level,\n"
          "and NaN below it")
      .def_ro("active", &Self::active,
              "(row, state) of each inequality row at or beyond a bound; a state is one of\n"
              "at lower, at upper, below lower, above upper")
      .def_ro(
          "certificate", &Self::certificate,
          "how far it is from its optimality conditions, if asked for: at most 1e-8 is rounding")
      .def_ro("verdict", &Self::verdict, "proven, not judged or not proven, if asked for")
      .def_ro("rests_on", &Self::rests_on,
              "index of the first level above that is not proven, so that this one isn't either;\n"
              "None where there is none")
      .def_prop_ro(
          "num_rows", [](const Self& self) { return self.report.num_rows; }, "at that tick")
      .def_prop_ro(
          "degrees_of_freedom_left",
          [](const Self& self) { return self.report.degrees_of_freedom_left; },
          "columns of the null space that this level leaves")
      .def_prop_ro(
          "iterations", [](const Self& self) { return self.report.iterations; },
          "of the active-set method")
      .def("__repr__", [](const Self& self) {
        return nb::str("Level({!r}, residual={:.3g}, active={})")
            .format(self.name, self.report.residual, self.active);
      });
}

}  // namespace surefoot::python
