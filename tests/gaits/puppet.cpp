#include "tests/gaits/puppet.hpp"

#include "surefoot/math/rotation.hpp"

#include <algorithm>

namespace surefoot::test {
namespace {

constexpr double kStiffness = 2e4;  // of the ground under a foot that comes down [N/m]
constexpr double kCarried = 75.0;   // by a foot on the ground [N]
constexpr double kWall = 0.02;      // ground this far above a foot stands in its way [m]
constexpr double kHeld = 15.0;      // force of such ground on it [N]
constexpr double kTouching = 1e-3;  // [m]

/// Its hips go down with its feet: no matter how low.
gaits::PlannerOptions of_any_height(gaits::PlannerOptions options) {
  options.swing.hip_height_min = -std::numeric_limits<double>::infinity();
  return options;
}

}  // namespace

Ground level_ground(double height) {
  return [height](const Vec2&) { return height; };
}

Ground step_at(double edge, double height) {
  return [edge, height](const Vec2& p) { return p.x() > edge ? height : 0.0; };
}

Puppet::Puppet(const gaits::PlannerOptions& options, Ground terrain, const Vec2& position,
               double heading, const std::vector<gaits::NamedGait>& gaits, int first)
    : ground(std::move(terrain)), planner_(of_any_height(options), kPeriod, {}, gaits, first) {
  const Mat3 R = rotation_about_z(heading);
  slide.fill(Vec2::Zero());
  double mean = 0.0;
  for (const Leg leg : kLegs) {
    Vec3& p = dynamics_.foot[index(leg)].p;
    p.head<2>() =
        position + R.topLeftCorner<2, 2>() * gaits::nominal_offset(options.stance, leg, kNumLegs);
    p.z() = ground(p.head<2>());
    dynamics_.hip[index(leg)].p = p + leg_length * Vec3::UnitZ();
    mean += 0.25 * p.z();
    state_.foot_force[index(leg)] = kCarried * Vec3::UnitZ();
  }
  state_.time = 0.0;
  state_.p_WB << position, mean + options.stance.height;
  state_.q_WB = Quat(R);
  state_.v_WB.setZero();
  state_.w_WB_B.setZero();
  dynamics_.mass = kWeight / kGravity;
  dynamics_.com.p = state_.p_WB;
  plan_ = planner_.update(user, state_, dynamics_, last);
}

void Puppet::place(Leg leg, const Vec2& place) {
  Vec3& p = dynamics_.foot[index(leg)].p;
  p << place, ground(place);
  dynamics_.hip[index(leg)].p = p + leg_length * Vec3::UnitZ();
}

void Puppet::fling(Leg leg, const Vec3& by, const Vec3& velocity) {
  dynamics_.foot[index(leg)].p += by;
  dynamics_.foot[index(leg)].v = velocity;
}

void Puppet::run(double duration, const std::function<void()>& each) {
  const double end = time() + duration - 0.5 * kPeriod;
  while (time() < end) {
    tick();
    each();
  }
}

void Puppet::tick() {
  state_.time += kPeriod;
  state_.external_force = push;
  move_body();
  for (std::size_t k = 0; k < kNumLegs; ++k) move_foot(k);
  planner_.tell_calibration_known(calibration_known);
  plan_ = planner_.update(user, state_, dynamics_, last);
  note_events();
}

void Puppet::move_body() {
  const ComPlan& com = plan_.com;
  if (com_follows) {
    dynamics_.com.p.head<2>() = com.p + kPeriod * com.v + 0.5 * kPeriod * kPeriod * com.a;
    dynamics_.com.v.head<2>() = com.v + kPeriod * com.a + blow;
  }
  const TorsoPlan& torso = plan_.torso;
  dynamics_.com.p.z() = torso.height;
  state_.p_WB = dynamics_.com.p;
  state_.v_WB << dynamics_.com.v.head<2>(), torso.height_rate;
  state_.v_WB.x() += drift;
  state_.q_WB = torso.q_WB;
  state_.w_WB_B = torso.q_WB.conjugate() * torso.w_WB;
}

void Puppet::move_foot(std::size_t k) {
  const FootPlan& reference = plan_.feet[k];
  Vec3& p = dynamics_.foot[k].p;
  double force = 0.0;
  Vec2 held = Vec2::Zero();
  if (in_contact(reference.phase)) {
    const bool touching = p.z() < ground(p.head<2>()) + kTouching;
    force = touching ? std::min(kCarried, sticky[k] ? kCarried : reference.force_max) : 0.0;
  } else {
    const Vec2 before = p.head<2>();
    p = reference.p_WF + kPeriod * reference.v_WF;
    if (ground(p.head<2>()) > p.z() + kWall) {  // no way through
      held = -kHeld * (p.head<2>() - before).normalized();
      p.head<2>() = before;
    }
    const double depth = ground(p.head<2>()) - p.z();
    if (depth > 0.0) p.z() += depth;
    force = std::clamp(kStiffness * depth, 0.0, kCarried);
  }
  state_.slips[k] = in_contact(reference.phase) && slide[k].norm() > 0.0;
  if (state_.slips[k]) held = slide[k];
  state_.foot_force[k] << held, force;
  dynamics_.hip[k].p = p + leg_length * Vec3::UnitZ();
}

void Puppet::note_events() {
  for (const GaitEvent& event : plan_.events) {
    const Leg leg = event.leg.value_or(Leg::LF);
    happenings_.push_back({time(), event.kind, leg, foot(leg)});
  }
}

std::vector<Happening> Puppet::happenings(PlanEvent event) const {
  std::vector<Happening> result;
  std::ranges::copy_if(happenings_, std::back_inserter(result),
                       [&](const Happening& h) { return h.event == event; });
  return result;
}

Happening Puppet::first_after(double time, PlanEvent event) const {
  const auto found = std::ranges::find_if(
      happenings_, [&](const Happening& h) { return h.time > time && h.event == event; });
  return found == happenings_.end() ? Happening{} : *found;
}

}  // namespace surefoot::test
