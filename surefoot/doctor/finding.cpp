#include "surefoot/doctor/finding.hpp"

#include <algorithm>
#include <tuple>

namespace surefoot::doctor {

const char* name(Severity severity) {
  switch (severity) {
    case Severity::error:
      return "error";
    case Severity::warning:
      return "warning";
    case Severity::note:
      return "note";
  }
  return "";
}

const char* name(Confidence confidence) {
  switch (confidence) {
    case Confidence::certain:
      return "certain";
    case Confidence::likely:
      return "likely";
    case Confidence::guess:
      return "guess";
  }
  return "";
}

void sort_worst_first(Findings& findings) {
  std::ranges::stable_sort(findings, {}, [](const Finding& finding) {
    return std::tuple(!finding.is_cause, finding.severity, finding.confidence);
  });
}

bool has_error(const Findings& findings) {
  return std::ranges::find(findings, Severity::error, &Finding::severity) != findings.end();
}

bool has_cause(const Findings& findings) {
  return std::ranges::find(findings, true, &Finding::is_cause) != findings.end();
}

Confidence of_refusal(const Findings& findings) {
  return has_error(findings) ? Confidence::likely : Confidence::certain;
}

}  // namespace surefoot::doctor
