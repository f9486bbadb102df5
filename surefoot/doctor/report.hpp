#pragma once

#include "surefoot/doctor/diagnosis.hpp"
#include "surefoot/doctor/trial.hpp"

#include <string>
#include <vector>

namespace surefoot::doctor {

/// For people: parts, measures, findings with the worst first, and trials.
[[nodiscard]] std::string report_text(const Diagnosis& robot, const std::vector<Trial>& trials);

/// The same as one JSON object.
[[nodiscard]] std::string report_json(const Diagnosis& robot, const std::vector<Trial>& trials);

}  // namespace surefoot::doctor
