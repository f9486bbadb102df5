#include "app/operator_forces.hpp"

#include "surefoot/base/formatted.hpp"

#include <algorithm>
#include <utility>

namespace surefoot {
namespace {

constexpr double kRunsOut = 0.2;          // in which a pull at the store's limit would empty it [s]
constexpr double kRounding = 1e-6;        // [N, N·s, s]
constexpr std::size_t kMostPushes = 100;  // that act at one time, however small

double end_of(const Push& push) { return push.time + push.duration; }

}  // namespace

OperatorForces::OperatorForces(const ViewLimits& limits, std::vector<std::string> bodies)
    : limits_(limits), bodies_(std::move(bodies)) {
  now_.store = limits.push_impulse;
}

void OperatorForces::advance(double time) {
  const double from = std::exchange(time_, time), passed = time - from;
  const double pulled = passed * now_.pull.force.norm();
  double promised = 0.0;  // that the pushes are still to give [N·s]
  now_.pull.given += pulled;
  for (const Push& push : pushes_) {
    const double acted = std::min(time, end_of(push)) - std::max(from, push.time);
    now_.push.given += push.force.norm() * std::max(acted, 0.0);
    promised += push.force.norm() * std::max(end_of(push) - time, 0.0);
  }
  now_.store =
      std::min(now_.store - pulled + limits_.push_refill * passed, limits_.push_impulse - promised);
  std::erase_if(pushes_, [&](const Push& push) { return end_of(push) <= time + kRounding; });
  sum_up();
}

std::string OperatorForces::push(const Push& push) {
  const double force = push.force.norm(), impulse = force * push.duration;
  const std::string what = formatted("the push of %.3g N·s, %.3g N is left out: ", impulse, force);
  if (pushes_.size() >= kMostPushes) {
    return what + std::to_string(kMostPushes) +
           " pushes act already or wait for the next tick; valid is one when they have ended";
  }
  if (force > limits_.push_force - pushing() + kRounding) {
    return what + formatted(
                      "pushes of %.3g N act already or wait for the next tick; valid is up to "
                      "%.3g N at one time",
                      pushing(), limits_.push_force);
  }
  if (impulse > now_.store + kRounding) {
    return what + formatted(
                      "%.3g N·s can be given now; valid is up to %.3g N·s at once, and %.3g N·s "
                      "more each second",
                      now_.store, limits_.push_impulse, limits_.push_refill);
  }
  if (pushes_.empty()) now_.push.given = 0.0;
  now_.store -= impulse;
  now_.push.body = place(push.body);
  pushes_.push_back(push);
  sum_up();
  return "";
}

Vec3 OperatorForces::bounded(const Vec3& wanted) const {
  const double most = std::min(limits_.push_force - pushing(), now_.store / kRunsOut);
  const double size = wanted.norm();
  return size <= most ? wanted : Vec3(std::max(most, 0.0) / size * wanted);
}

bool OperatorForces::is_too_much(double duration) const {
  const double pulling = now_.pull.force.norm();
  return pulling > limits_.push_force - pushing() + kRounding || pulling * duration > now_.store;
}

void OperatorForces::pull(const Pull& pull, bool is_weaker) {
  const int body = place(pull.body);
  if (body != now_.pull.body) now_.pull.given = 0.0;
  now_.pull.force = pull.force;
  now_.pull.body = pull.force.isZero() ? -1 : body;
  now_.is_weaker = is_weaker;
}

int OperatorForces::place(const std::string& body) const {
  return static_cast<int>(std::ranges::find(bodies_, body) - bodies_.begin());
}

double OperatorForces::pushing() const {
  double sum = 0.0;
  for (const Push& push : pushes_) sum += push.force.norm();
  return sum;
}

void OperatorForces::sum_up() {
  if (pushes_.empty()) now_.push.body = -1;
  now_.push.force.setZero();
  for (const Push& push : pushes_) now_.push.force += push.force;
}

}  // namespace surefoot
