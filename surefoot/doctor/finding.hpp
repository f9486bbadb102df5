#pragma once

#include <string>
#include <vector>

namespace surefoot::doctor {

/// An error stops the robot from walking, a warning may, a note is worth knowing.
enum class Severity { error, warning, note };
/// How sure a finding is: read from the file, concluded, or guessed by what is usual.
enum class Confidence { certain, likely, guess };

[[nodiscard]] const char* name(Severity severity);
[[nodiscard]] const char* name(Confidence confidence);

/// Something about a robot's description that its owner must or may change.
struct Finding {
  Severity severity = Severity::note;
  Confidence confidence = Confidence::certain;
  std::string subject;    ///< `joint "LF_HAA"`, `link "base"`, `legs`
  int line = 0;           ///< of it in the URDF; 0: none
  std::string what;       ///< what is seen, and what it means
  std::string remedy;     ///< what to do; empty: nothing
  bool is_cause = false;  ///< others would only follow from it, and wait until it is mended
};

using Findings = std::vector<Finding>;

/// Causes first, then errors, warnings and notes; the surest of each first.
void sort_worst_first(Findings& findings);

[[nodiscard]] bool has_error(const Findings& findings);
[[nodiscard]] bool has_cause(const Findings& findings);

/// Of an error that the program itself tells: beside others it may only follow from them, and comes
/// behind them.
[[nodiscard]] Confidence of_refusal(const Findings& findings);

}  // namespace surefoot::doctor
