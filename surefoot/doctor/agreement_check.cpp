#include "surefoot/base/error.hpp"
#include "surefoot/doctor/checks.hpp"
#include "surefoot/simulation/model_agreement.hpp"

namespace surefoot::doctor {

void check_agreement(Diagnosis& robot) {
  constexpr int kPostures = 100;
  if (!robot.robot) return;
  try {
    for (const std::string& line : simulation::disagreements(*robot.robot, kPostures)) {
      const std::size_t colon = line.find(": ");
      robot.findings.push_back(
          {Severity::error, Confidence::certain, line.substr(0, colon), 0,
           "the file is ambiguous: it means another robot to MuJoCo: " + line.substr(colon + 2),
           "write this element so that it can be read in one way only; if "
           "it is, please report it with the file"});
    }
  } catch (const Error&) {
    return;  // check_stance tells it
  }
}

}  // namespace surefoot::doctor
