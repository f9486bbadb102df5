#include "python/bindings.hpp"
#include "python/explanation.hpp"
#include "python/level_dict.hpp"
#include "python/own_parts.hpp"
#include "python/while_others_run.hpp"
#include "surefoot/explain/explain.hpp"

#include <nanobind/stl/filesystem.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <string>

namespace surefoot::python {
namespace {

Explanation explain_log(const std::filesystem::path& log, double time, bool exact,
                        const nb::object& own) {
  if (!std::isfinite(time)) throw Error("time is " + text(time) + "; expected seconds of the log");
  const tasks::OwnTasks tasks = own_tasks_of_run(own);
  const explain::Costs costs = exact ? explain::Costs::exact : explain::Costs::estimated;
  return while_others_run([&](const std::function<bool()>& stops) {
    return Explanation::of(explain::explain_tick(log, time, costs, stops, tasks));
  });
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
      nb::arg("own_tasks") = nb::tuple(),
      nb::sig(
          "def explain(log: str | os.PathLike[str], time: float, exact: bool = True, own_tasks: "
          "typing.Sequence[typing.Any] = ()) -> Explanation"),
      "Explains the tick of a log next to a time [s], as `surefoot explain` does.\n\n"
      "The log's controller is computed again up to the tick, for what the rows that held levels\n"
      "back really cost. exact=False is fast: their costs are the control loop's estimates. Where\n"
      "exact ones can't be computed, facts[\"why_estimates\"] says why.\n"
      "own_tasks: your own of the run, as they were at its start; registered ones are known.\n"
      "Raises FileError where the log can't be read, and Error, with the log's range, where it "
      "has\n"
      "no tick at that time.");
}

}  // namespace surefoot::python
