#include "surefoot/simulation/disturbances.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/math/smoothstep.hpp"
#include "surefoot/simulation/text.hpp"

#include <algorithm>

namespace surefoot::simulation {

namespace {

// MuJoCo needs a positive inertia; this is a millimetre-sized lump's.
constexpr double kPointInertia = 1e-9;

// The lifting hand: a robot of 30 kg hangs 3 cm lower, and swings to rest within a second.
constexpr double kHandStiffness = 1e4;  // [N/m]
constexpr double kHandDamping = 3e2;    // [N·s/m]
constexpr double kReleaseDepth = 0.15;  // below its start [m]

constexpr double kDiscardTime = 1.0;  // after a push's end, when no step includes it any more [s]

void scale_mass(mjsBody& body, double scale) {
  body.mass *= scale;
  for (double& value : body.inertia) value *= scale;
  for (double& value : body.fullinertia) value *= scale;
}

void shift_center_of_mass(mjsBody& body, const Vec3& offset) {
  for (int i = 0; i < 3; ++i) body.ipos[i] += offset[i];
}

/// Mass scale of the link behind this joint.
double link_scale(mjsElement& joint, const model::RobotDescription& description,
                  const DisturbanceOptions& options) {
  if (!description.can_walk()) return options.leg_mass_scale;
  for (std::size_t leg = 0; leg < description.legs.size(); ++leg) {
    for (std::size_t j = 0; j < kJointsPerLeg; ++j) {
      if (description.legs[leg].joints[j] != name_of(&joint)) continue;
      const auto i = static_cast<Eigen::Index>(leg * kJointsPerLeg + j);
      return options.leg_mass_scale * options.link_mass_scale[i];
    }
  }
  return options.leg_mass_scale;
}

/// Traverses the tree of bodies.
class MassDisturber {
 public:
  MassDisturber(const model::RobotDescription& description, const DisturbanceOptions& options)
      : description_(description), options_(options) {}

  /// `scale` is the parent link's; `q_Xbase` turns base coordinates into the body's, as long as it
  /// is fixed to the base.
  void disturb(mjsBody& body, double scale, bool fixed_to_base, const Quat& q_Xbase) const {
    scale_mass(body, scale);
    if (fixed_to_base && body.mass > 0.0) {
      shift_center_of_mass(body, q_Xbase * options_.base_com_offset);
    }
    for (mjsElement* element = mjs_firstChild(&body, mjOBJ_BODY, 0); element != nullptr;
         element = mjs_nextChild(&body, element, 0)) {
      mjsBody& child = *mjs_asBody(element);
      mjsElement* joint = mjs_firstChild(&child, mjOBJ_JOINT, 0);
      const Quat q_BX(child.quat[0], child.quat[1], child.quat[2], child.quat[3]);
      disturb(child, joint == nullptr ? scale : link_scale(*joint, description_, options_),
              fixed_to_base && joint == nullptr, q_BX.conjugate() * q_Xbase);
    }
  }

 private:
  const model::RobotDescription& description_;
  const DisturbanceOptions& options_;
};

void add_payload(mjsBody& base, const Payload& payload) {
  mjsBody* body = mjs_addBody(&base, nullptr);
  mjs_setName(body->element, "payload");
  for (int i = 0; i < 3; ++i) body->pos[i] = payload.position[i];
  body->explicitinertial = 1;
  body->mass = payload.mass;
  for (double& value : body->ipos) value = 0.0;  // undefined by default: MuJoCo ignores the mass
  for (double& value : body->inertia) value = kPointInertia;
}

std::vector<std::string> body_names(const mjModel& model) {
  std::vector<std::string> names;
  for (int body = 1; body < model.nbody; ++body) {
    names.emplace_back(mj_id2name(&model, mjOBJ_BODY, body));
  }
  return names;
}

/// Share of [time, time + timestep] that the push covers.
double share(const Push& push, double time, double timestep) {
  const double start = std::max(time, push.time);
  const double end = std::min(time + timestep, push.time + push.duration);
  return std::max(0.0, end - start) / timestep;
}

/// Position of a body's point in S [m].
Vec3 place(const mjData& data, int body, const Vec3& point) {
  using RotationRows = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>;
  return Eigen::Map<const Vec3>(data.xpos + 3 * body) + RotationRows(data.xmat + 9 * body) * point;
}

/// MuJoCo's external force acts at the body's centre of mass.
void add_force(int body, const Vec3& p_W, const Vec3& force, mjData& data) {
  const Vec3 arm = p_W - Eigen::Map<const Vec3>(data.xipos + 3 * body);
  const Vec3 moment = arm.cross(force);
  for (int i = 0; i < 3; ++i) {
    data.xfrc_applied[6 * body + i] += force[i];
    data.xfrc_applied[6 * body + 3 + i] += moment[i];
  }
}

}  // namespace

void disturb_masses(mjsBody& base, const model::RobotDescription& description,
                    const DisturbanceOptions& options) {
  const MassDisturber masses(description, options);
  masses.disturb(base, options.base_mass_scale, true, Quat::Identity());
  if (options.payload.mass > 0.0) add_payload(base, options.payload);
}

Vec3 Hand::force(double time, const Vec3& p_W, const Vec3& v_W) noexcept {
  const double t = time - lift_.time;
  if (t < 0.0 || t > 2.0 * lift_.duration + lift_.hold) return Vec3::Zero();
  if (!begin_.allFinite()) begin_ = p_W;
  const double stiffness = scale_.force() / scale_.length * kHandStiffness;
  const double damping = scale_.force() / scale_.speed() * kHandDamping;
  const double pull = stiffness * (begin_.z() + height(t) - p_W.z());
  if (!(pull > 0.0)) return Vec3::Zero();
  Vec3 force = pull * Vec3::UnitZ() - damping * v_W;
  force.z() = std::max(0.0, force.z());
  return force;
}

double Hand::height(double time) const {
  const double down = time - lift_.duration - lift_.hold;
  if (down < 0.0) return lift_.height * smoothstep(std::min(1.0, time / lift_.duration));
  const double lowest = -(scale_.length * kReleaseDepth);
  return lift_.height + (lowest - lift_.height) * smoothstep(down / lift_.duration);
}

Pushes::Pushes(const DisturbanceOptions& disturbances, const mjModel& model,
               const std::string& base_link, const Scale& scale)
    : model_(model), base_link_(base_link), base_(id_of(model, mjOBJ_BODY, base_link)) {
  for (const Lift& lift : disturbances.lifts) hands_.emplace_back(lift, scale);
  const std::vector<Push>& pushes = disturbances.pushes;
  for (std::size_t i = 0; i < pushes.size(); ++i) {
    const std::string key = text("disturbances.pushes[", i, "].body");
    forces_.push_back({pushes[i], body_of(pushes[i].body, key)});
  }
}

int Pushes::body_of(const std::string& body, const std::string& key) const {
  const std::string name = body.empty() ? base_link_ : body;
  const int id = name == "world" ? -1 : id_of(model_, mjOBJ_BODY, name);
  if (id >= 0) return id;
  throw UnknownNameError(
      text(key, " is \"", name, "\"; the robot has: ", listed(body_names(model_))));
}

std::vector<std::string> Pushes::bodies() const { return body_names(model_); }

void Pushes::add(const Push& push, double time) {
  std::erase_if(forces_, [&](const Force& force) {
    return force.push.time + force.push.duration + kDiscardTime < time;
  });
  forces_.push_back({push, body_of(push.body, "the pushed body")});
}

void Pushes::apply(double timestep, mjData& data) noexcept {
  const auto clear = [&](int body) { std::fill_n(data.xfrc_applied + 6 * body, 6, 0.0); };
  for (const Force& force : forces_) clear(force.body);
  if (!hands_.empty()) clear(base_);
  for (const Force& force : forces_) {
    const double part = share(force.push, data.time, timestep);
    for (int i = 0; i < 3; ++i) data.xfrc_applied[6 * force.body + i] += part * force.push.force[i];
  }
  for (Hand& hand : hands_) lift(hand, data);
}

void Pushes::lift(Hand& hand, mjData& data) const noexcept {
  const Vec3 p_W = place(data, base_, hand.point());
  std::array<mjtNum, 6> velocity{};  // of the body's origin: rotation, then translation, in S
  mj_objectVelocity(&model_, &data, mjOBJ_XBODY, base_, velocity.data(), 0);
  const Vec3 w(velocity.data()), v(velocity.data() + 3);
  const Vec3 v_W = v + w.cross(p_W - Vec3(data.xpos + 3 * base_));
  add_force(base_, p_W, hand.force(data.time, p_W, v_W), data);
}

}  // namespace surefoot::simulation
