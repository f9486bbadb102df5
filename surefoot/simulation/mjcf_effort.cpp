#include "surefoot/simulation/mjcf_effort.hpp"

#include "surefoot/math/numbers.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::simulation {
namespace {

/// The smaller side of a range about 0.
double bound(const double* range) { return std::min(std::abs(range[0]), std::abs(range[1])); }

/// Of a motor the control is a force; of a servo it is a position or a velocity.
bool is_motor(const mjsActuator& actuator) {
  return actuator.gaintype == mjGAIN_FIXED && actuator.biastype == mjBIAS_NONE;
}

double effort_of(const mjSpec& spec, const mjsActuator& actuator) {
  double effort = kInfinity;
  if (is_limited(spec, actuator.forcelimited, actuator.forcerange))
    effort = bound(actuator.forcerange);
  if (is_motor(actuator) && is_limited(spec, actuator.ctrllimited, actuator.ctrlrange))
    effort = std::min(effort, std::abs(actuator.gainprm[0]) * bound(actuator.ctrlrange));
  return effort * std::abs(actuator.gear[0]);
}

}  // namespace

bool is_limited(const mjSpec& spec, mjtLimited flag, const double* range) {
  if (flag == mjLIMITED_AUTO) return spec.compiler.autolimits != 0 && range[0] < range[1];
  return flag == mjLIMITED_TRUE;
}

std::map<std::string, double> effort_limits(const mjSpec& spec) {
  std::map<std::string, double> limits;
  for (mjsElement* element = mjs_firstElement(&spec, mjOBJ_ACTUATOR); element != nullptr;
       element = mjs_nextElement(&spec, element)) {
    const mjsActuator& actuator = *mjs_asActuator(element);
    if (actuator.trntype != mjTRN_JOINT && actuator.trntype != mjTRN_JOINTINPARENT) continue;
    limits[mjs_getString(actuator.target)] += effort_of(spec, actuator);
  }
  for (mjsElement* element = mjs_firstElement(&spec, mjOBJ_JOINT); element != nullptr;
       element = mjs_nextElement(&spec, element)) {
    const mjsJoint& joint = *mjs_asJoint(element);
    if (!is_limited(spec, joint.actfrclimited, joint.actfrcrange)) continue;
    double& limit = limits.try_emplace(name_of(element), kInfinity).first->second;
    limit = std::min(limit, bound(joint.actfrcrange));
  }
  std::erase_if(limits, [](const auto& limit) { return !std::isfinite(limit.second); });
  return limits;
}

}  // namespace surefoot::simulation
