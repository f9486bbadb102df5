#include "python/bindings.hpp"
#include "python/robot.hpp"
#include "python/while_others_run.hpp"
#include "surefoot/base/error.hpp"
#include "surefoot/base/printable.hpp"
#include "surefoot/doctor/picture.hpp"
#include "surefoot/doctor/report.hpp"
#include "surefoot/doctor/robot_file_text.hpp"
#include "surefoot/doctor/trial.hpp"

#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/vector.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace surefoot::python {
namespace {

/// `Diagnosis` in Python.
struct Examined {
  doctor::Diagnosis diagnosis;
  std::vector<doctor::Trial> trials;
};

Examined examine(const std::filesystem::path& description, const std::string& name, bool walk) {
  return while_others_run([&](const std::function<bool()>& stops) {
    Examined result{.diagnosis = doctor::examine(description.string(), name), .trials = {}};
    if (walk && result.diagnosis.robot) {
      doctor::TrialOptions options;
      options.interrupted = stops;
      result.trials = doctor::try_walking(result.diagnosis, options);
    }
    return result;
  });
}

void bind_finding(nb::module_& module) {
  using doctor::Finding;
  nb::class_<Finding>(module, "Finding", "What the owner of a robot's description may change.")
      .def_prop_ro(
          "severity", [](const Finding& self) { return std::string(name(self.severity)); },
          "error (the robot can't walk), warning or note")
      .def_prop_ro(
          "confidence", [](const Finding& self) { return std::string(name(self.confidence)); },
          "certain, likely or guess")
      .def_ro("subject", &Finding::subject, "as `joint \"LF_HAA\"`")
      .def_ro("line", &Finding::line, "of it in the URDF; 0: none")
      .def_ro("what", &Finding::what, "what is seen, and what it means")
      .def_ro("remedy", &Finding::remedy, "what to do; empty: nothing")
      .def("__repr__", [](const Finding& self) {
        return "<" + std::string(name(self.severity)) + ": " + self.subject + ": " + self.what +
               ">";
      });
  using doctor::Trial;
  nb::class_<Trial>(module, "Trial", "How a scenario went with a robot.")
      .def_ro("scenario", &Trial::scenario, "its name")
      .def_ro("succeeded", &Trial::succeeded, "by the scenario's criteria")
      .def_ro("why", &Trial::why, "how it ended, and the criteria that were missed")
      .def("__repr__", [](const Trial& self) {
        return "<" + self.scenario + (self.succeeded ? ": succeeded" : ": " + self.why) + ">";
      });
}

}  // namespace

void bind_doctor(nb::module_& module) {
  bind_finding(module);
  using Self = Examined;
  nb::class_<Self>(module, "Diagnosis", "What the doctor found of a robot's description.")
      .def_prop_ro(
          "findings", [](const Self& self) { return self.diagnosis.findings; }, "worst first")
      .def_ro("trials", &Self::trials, "with walk=True")
      .def_prop_ro(
          "can_walk", [](const Self& self) { return self.diagnosis.robot.has_value(); },
          "nothing of what was found forbids a controller")
      .def_prop_ro(
          "robot", [](const Self& self) { return std::make_shared<Robot>(self.diagnosis); },
          "With guesses for what the description lacks. Raises Error, with the errors found, where "
          "it can't walk.")
      .def(
          "write",
          [](const Self& self, const std::filesystem::path& file) {
            doctor::write_robot_file(self.diagnosis, file);
            return doctor::write_picture(self.diagnosis, file);
          },
          nb::arg("file"), nb::sig("def write(self, file: str | os.PathLike[str]) -> pathlib.Path"),
          "Writes a robot file (.yaml), with guesses as comments, and its picture beside it; "
          "returns "
          "the picture's path.")
      .def_prop_ro(
          "picture", [](const Self& self) { return doctor::picture(self.diagnosis); },
          "the robot as SVG, for a notebook")
      .def("_repr_svg_", [](const Self& self) { return doctor::picture(self.diagnosis); })
      .def("__str__",
           [](const Self& self) {
             return printable(doctor::report_text(self.diagnosis, self.trials), "\n");
           })
      .def("__repr__", [](const Self& self) {
        return "<diagnosis of " + self.diagnosis.name + ", " +
               std::to_string(self.diagnosis.findings.size()) + " findings>";
      });

  module.def(
      "doctor", &examine, nb::arg("description"), nb::arg("name") = "", nb::arg("walk") = false,
      nb::sig("def doctor(description: str | os.PathLike[str], name: str = '', walk: bool = False) "
              "-> Diagnosis"),
      "Examines a URDF or MJCF: its parts, units, limits, symmetry, signs, and whether it can "
      "stand.\n\nwalk=True also walks on flat ground and down a step, in simulation.");
}

}  // namespace surefoot::python
