#include "surefoot/logging/applied_force.hpp"

#include "surefoot/base/formatted.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

namespace surefoot::logging {
namespace {

constexpr double kMinShare = 0.38;  // of a force, along a direction that is named: sin 22.5°
constexpr double kMinForce = 1e-6;  // less is rounding at a push's last step [N]

double yaw_of(const Quat& q) {
  return std::atan2(2.0 * (q.w() * q.z() + q.x() * q.y()),
                    1.0 - 2.0 * (q.y() * q.y() + q.z() * q.z()));
}

std::string direction(const AppliedForce& force) {
  const double up = force.force.z() / force.force.norm();
  std::string out;
  if (std::hypot(force.force.x(), force.force.y()) > kMinShare * force.force.norm()) {
    const double degrees = std::round(180.0 / kPi * angle_from_ahead(force));
    out = formatted(", %.0f° from ahead", std::abs(degrees));
    if (degrees != 0.0 && std::abs(degrees) != 180.0)
      out += degrees > 0.0 ? " to the left" : " to the right";
  }
  if (std::abs(up) > kMinShare)
    out += (out.empty() ? ", " : " and ") + std::string(up > 0.0 ? "upwards" : "downwards");
  return out;
}

}  // namespace

std::vector<AppliedForce> applied_forces(double time, const std::vector<double>& xfrc,
                                         const Quat& q_SB) {
  std::vector<AppliedForce> forces;
  for (std::size_t body = 1; 6 * body + 6 <= xfrc.size(); ++body) {
    const Vec3 force(xfrc[6 * body], xfrc[6 * body + 1], xfrc[6 * body + 2]);
    if (force.allFinite() && force.norm() > kMinForce)
      forces.push_back({.body = body, .from = time, .to = kNaN, .force = force, .q_SB = q_SB});
  }
  return forces;
}

AppliedForceWatch::Changes AppliedForceWatch::see(double time, const std::vector<double>& xfrc,
                                                  const Quat& q_SB) {
  Changes changes;
  const bool is_first = !last_.has_value();
  const double before = last_.value_or(time);
  last_ = time;
  std::vector<Followed> now;
  for (const AppliedForce& force : applied_forces(before, xfrc, q_SB)) {
    const auto goes_on = std::ranges::find_if(
        followed_, [&](const Followed& one) { return one.force.body == force.body; });
    if (goes_on == followed_.end()) {
      now.push_back({force, is_first});
      continue;
    }
    Followed& one = now.emplace_back(*goes_on);
    if (force.force.norm() > one.force.force.norm() * (1.0 + 1e-6)) {
      one.force.force = force.force;
      one.force.q_SB = force.q_SB;
    }
    if (!std::exchange(one.is_reported, true)) changes.begun.push_back(one.force);
    followed_.erase(goes_on);
  }
  for (Followed& one : followed_) {
    if (!one.is_reported) changes.begun.push_back(one.force);
    one.force.to = before;
    changes.ended.push_back(one.force);
  }
  followed_ = std::move(now);
  return changes;
}

std::vector<AppliedForce> AppliedForceWatch::acting() const {
  std::vector<AppliedForce> forces;
  for (const Followed& one : followed_) forces.push_back(one.force);
  return forces;
}

// MuJoCo numbers bodies in the file's order, after the world.
std::vector<std::string> body_names(const LogHeader& header) {
  const std::string* model = header.attachment("model.xml");
  if (model == nullptr) return {};
  constexpr std::string_view kBegin = "<body name=\"";
  std::vector<std::string> names{"world"};
  for (std::size_t at = model->find(kBegin); at != std::string::npos;
       at = model->find(kBegin, at)) {
    at += kBegin.size();
    names.push_back(model->substr(at, model->find('"', at) - at));
  }
  return names;
}

double angle_from_ahead(const AppliedForce& force) {
  if (std::hypot(force.force.x(), force.force.y()) == 0.0) return kNaN;
  const double angle = std::atan2(force.force.y(), force.force.x()) - yaw_of(force.q_SB);
  return std::remainder(angle, 2.0 * kPi);
}

std::string body_text(std::size_t body, const std::vector<std::string>& bodies) {
  if (body == 1) return "the base";
  return body < bodies.size() ? bodies[body] : "body " + std::to_string(body);
}

std::string applied_force_text(const AppliedForce& force, const std::vector<std::string>& bodies) {
  return formatted("%.3g N", force.force.norm()) + direction(force) + ", on " +
         body_text(force.body, bodies);
}

std::string push_text(const AppliedForce& force, const std::vector<std::string>& bodies) {
  return "pushed by " + applied_force_text(force, bodies);
}

std::string push_end_text(const AppliedForce& force, const std::vector<std::string>& bodies) {
  return "the push on " + body_text(force.body, bodies) + " ends";
}

}  // namespace surefoot::logging
