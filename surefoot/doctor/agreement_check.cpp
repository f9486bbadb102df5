#include "surefoot/base/error.hpp"
#include "surefoot/doctor/checks.hpp"
#include "surefoot/simulation/model_agreement.hpp"

namespace surefoot::doctor {

void check_agreement(Diagnosis& robot) {
  constexpr int kPostures = 10;
  if (!robot.robot) return;
  try {
    for (const std::string& line : simulation::disagreements(*robot.robot, kPostures)) {
      const std::size_t colon = line.find(": ");
      robot.findings.push_back({Severity::error, Confidence::certain, line.substr(0, colon), 0,
                                "controller and physics differ: " + line.substr(colon + 2),
                                "this is a fault of the program: please report it with the file"});
    }
  } catch (const Error&) {
    return;  // check_stance tells it
  }
}

}  // namespace surefoot::doctor
