#pragma once

#include "surefoot/doctor/finding.hpp"
#include "surefoot/model/urdf.hpp"

#include <string>

namespace surefoot::doctor {

/// Links or joints with the same fault, in one finding, at the first of them.
class PartList {
 public:
  /// `what` is wrong with it, told of the first.
  void add(const model::UrdfLink& link, const std::string& what) {
    add("link", link.name, link.line, what);
  }
  void add(const model::UrdfJoint& joint, const std::string& what) {
    add("joint", joint.name, joint.line, what);
  }
  void tell(Severity severity, Confidence confidence, const std::string& remedy, Findings& findings,
            bool is_cause = false) const {
    if (subject_.empty()) return;
    findings.push_back({severity, confidence, subject_, line_,
                        what_ + (others_.empty() ? "" : "; so it is with" + others_), remedy,
                        is_cause});
  }

 private:
  void add(const char* kind, const std::string& name, int line, const std::string& what) {
    if (!subject_.empty()) {
      others_ += " " + name;
      return;
    }
    subject_ = std::string(kind) + " \"" + name + "\"";
    line_ = line;
    what_ = what;
  }

  std::string subject_, what_, others_;
  int line_ = 0;
};

}  // namespace surefoot::doctor
