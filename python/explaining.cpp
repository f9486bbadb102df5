#include "python/bindings.hpp"
#include "python/explanation.hpp"
#include "python/interpreter.hpp"
#include "python/level_dict.hpp"
#include "surefoot/explain/explain.hpp"

#include <nanobind/stl/filesystem.h>

#include <cmath>
#include <filesystem>
#include <string>

namespace surefoot::python {
namespace {

Explanation explain_log(const std::filesystem::path& log, double time, bool exact) {
  if (!std::isfinite(time)) throw Error("time is " + text(time) + "; expected seconds of the log");
  const Interpreter::Unlocked others_may_run;
  const auto stops = [] {
    const Interpreter::Locked python;
    if (PyErr_CheckSignals() != 0) throw nb::python_error();
    return false;
  };
  return Explanation::of(explain::explain_tick(
      log, time, exact ? explain::Costs::exact : explain::Costs::estimated, stops));
}

}  // namespace

void bind_explaining(nb::module_& module) {
  using Self = Explanation;
  nb::class_<Self>(module, "Explanation", "What gave way to what, and at what cost.")
      .def_ro("text", &Self::text, "for people, in lines")
      .def_prop_ro(
          "facts",
          [](const Self& self) {
            return nb::cast<nb::dict>(
                nb::module_::import_("json").attr("loads")(nb::str(self.json.c_str())));
          },
          nb::sig("def facts(self) -> dict[str, typing.Any]"),
          "the same, whole, as `--json` of the program has it: SI units, and of costs and "
          "residuals "
          "the level's")
      .def("__str__", [](const Self& self) { return self.text; });

  module.def(
      "explain", &explain_log, nb::arg("log"), nb::arg("time"), nb::arg("exact") = true,
      nb::sig("def explain(log: str | os.PathLike[str], time: float, exact: bool = True) -> "
              "Explanation"),
      "Explains the tick of a log next to a time [s], as `surefoot explain` does.\n\n"
      "The log's controller is computed again up to the tick, for what the rows that held levels\n"
      "back really cost. exact=False is fast: their costs are the control loop's estimates. Where\n"
      "exact ones can't be computed, facts[\"why_estimates\"] says why.\n"
      "Raises FileError where the log can't be read, and Error, with the log's range, where it "
      "has\n"
      "no tick at that time.");
}

}  // namespace surefoot::python
