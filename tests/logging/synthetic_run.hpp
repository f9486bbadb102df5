#pragma once

#include "surefoot/logging/log_header.hpp"
#include "surefoot/signals/tick_record.hpp"
#include "surefoot/simulation/ground_truth.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>

namespace surefoot::test {

/// A run that never happened but looks like one: a walk of a quadruped in the order LH LF RH RF
/// with swaying centre of mass; from `step_time` on a front foot searches for ground 14 cm deeper
/// and the torso follows. Every member of the signals has some value of its own, with noise that
/// depends on the seed alone.
class SyntheticRun {
 public:
  static constexpr double kPeriod = 0.0025;

  explicit SyntheticRun(std::uint64_t seed = 1, double step_time = 1e9)
      : random_(seed), step_time_(step_time) {}

  [[nodiscard]] static logging::LogHeader header() {
    logging::LogHeader header;
    header.version = "0.1.0";
    header.commit = "0123456789ab";
    header.command = "bin/surefoot run synthetic --seed 7 --set gait.swing_duration=0.5";
    header.scenario = "synthetic";
    header.description = "a walk that never happened";
    header.drawn = {{"initial.x", -0.05}};
    header.stack = "terrain_adaptation";
    header.estimation = "truth";
    header.options =
        R"({"gait":{"swing_duration":0.5},"paper":{"com_error_max_m":"≤ 3.4 mm, on the robot"}})";
    header.seed = 7;
    header.level_names = {
        "equations of motion", "no contact motion", "torque limits", "friction", "COM",
        "swing foot",          "limb limits",       "yaw",           "height",   "roll and pitch",
        "contact forces"};
    header.level_units = {"",     "m/s²",   "N·m",  "N",      "m/s²", "m/s²",
                          "m/s²", "rad/s²", "m/s²", "rad/s²", "N"};
    header.level_visible.assign(header.level_names.size(), 0.03);
    header.event_names = {"none", "lift-off", "touchdown"};
    header.robot.name = "anymal_b";
    for (int j = 0; j < kNumLegJoints; ++j)
      header.robot.joint_names[static_cast<std::size_t>(j)] = leg_joint_name(j);
    header.robot.torque_limit.setConstant(40.0);
    header.robot.mass = 30.4;
    header.robot.foot_radius = 0.031;
    header.limb = {6, "radial", 0.18, 0.535};
    // The ground ends 14 cm deeper at x = 0.5.
    header.terrain = {{.shape = "box", .position = {-1.5, 0.0, -0.5}, .size = {4.0, 4.0, 1.0}},
                      {.shape = "plane", .position = {0.0, 0.0, -0.14}}};
    header.notes = {"dropped the dummy inertia of the root link"};
    header.attachments = {{"model.xml", "application/xml", "<mujoco model=\"none\"/>"}};
    header.row_name = [](int level, std::int32_t id) {
      const std::string leg(kLegNames[static_cast<std::size_t>(id)]);
      return leg + (level == 6 ? " extension" : " slip forward");
    };
    return header;
  }

  /// Advances by a tick.
  void step() {
    time_ = kPeriod * tick_++;
    plan();
    state();
    model_and_truth();
    hierarchy();
    command();
    timing.time = time_;
    timing.estimate = 2.0 + std::abs(noise(0.5));
    timing.plan = 6.0 + std::abs(noise(2.0));
    timing.model = 14.0 + std::abs(noise(1.0));
    timing.stack = 9.0 + std::abs(noise(1.0));
    timing.solve = 160.0 + std::abs(noise(25.0));
    timing.levels = kNoLevelTimes;
    for (std::size_t k = 2; k < 7; ++k) timing.levels[k] = static_cast<float>(tick_ % 977) * 0.125F;
    timing.total = timing.estimate + timing.plan + timing.model + timing.stack + timing.solve;
  }

  TickRecord tick;
  simulation::GroundTruth truth;
  TickTiming timing;

 private:
  static constexpr double kSwing = 0.5, kCycle = 3.0, kStride = 0.18;
  static constexpr PerLeg<double> kStart{0.75, 2.25, 0.0, 1.5};  // of the swing in the cycle, [s]

  double noise(double deviation) { return deviation * normal_(random_); }
  Vec3 noise3(double deviation) { return {noise(deviation), noise(deviation), noise(deviation)}; }

  // 0 … 1 … 0 around the step-down.
  [[nodiscard]] double adaptation() const {
    const double s = (time_ - step_time_) / 2.5;
    return s <= 0.0 || s >= 1.0 ? 0.0 : std::pow(std::sin(kPi * s), 2);
  }

  void plan() {
    MotionPlan& plan = tick.plan;
    plan.time = time_;
    for (FootPlan& foot : plan.feet) foot.friction = 0.6;
    plan.events = {};
    const double walk = std::max(0.0, time_ - 1.0);
    tick.user = {.walk = time_ >= 1.0, .velocity = Vec2(kStride / kCycle, 0.0)};
    for (const Leg leg : kLegs) {
      const double in_cycle = std::fmod(walk - kStart[index(leg)] + kCycle, kCycle);
      const double steps = std::floor((walk - kStart[index(leg)]) / kCycle) + 1.0;
      const double s =
          walk > 0.0 && walk >= kStart[index(leg)] ? std::min(in_cycle / kSwing, 1.0) : 1.0;
      FootPlan& foot = plan.feet[index(leg)];
      const LegPhase before = foot.phase;
      foot.phase = s < 1.0 ? LegPhase::swing : LegPhase::stance;
      const bool lowered = time_ > step_time_ && leg == Leg::RF;
      if (lowered && time_ < step_time_ + 1.2) foot.phase = LegPhase::search;
      const PlanEvent event = in_contact(foot.phase) ? PlanEvent::touchdown : PlanEvent::lift_off;
      if (before != foot.phase)
        plan.events.add({.kind = event, .leg = leg, .place = foot.p_WF, .force = 12.5});
      const double smooth = s * s * s * (10.0 + s * (-15.0 + 6.0 * s));
      const double x =
          (is_front(leg) ? 0.38 : -0.38) + kStride * (std::max(steps, 0.0) - 1.0 + smooth);
      const double drop = lowered ? 0.14 * std::min((time_ - step_time_) / 1.2, 1.0) : 0.0;
      foot.p_WF = {x, is_left(leg) ? 0.22 : -0.22, 0.031 + 0.08 * std::sin(kPi * s) - drop};
      foot.force_min = 10.0;
      foot.force_max = in_contact(foot.phase) ? 250.0 : 0.0;
    }
    const double sway = 2.0 * kPi / kCycle;
    plan.com.p = {kStride / kCycle * walk + 0.008 * std::sin(2.0 * sway * walk),
                  -0.05 * std::sin(sway * walk)};
    plan.com.v = {kStride / kCycle, -0.05 * sway * std::cos(sway * walk)};
    plan.com.zmp = plan.com.p + Vec2(0.0, 0.012 * std::sin(sway * walk));
    plan.torso.height = 0.49 - (time_ > step_time_ + 1.2 ? 0.035 : 0.0);
  }

  void state() {
    RobotState& state = tick.state;
    const double a = adaptation();
    state.time = tick.reading.time = time_;
    state.p_WB = {tick.plan.com.p.x(), tick.plan.com.p.y(),
                  tick.plan.torso.height - 0.02 * a * a * a};
    state.q_WB = Quat(Eigen::AngleAxisd(0.20 * a, Vec3::UnitY()) *
                      Eigen::AngleAxisd(-0.11 * a, Vec3::UnitX()));
    state.q_WB = state.q_WB * Quat(1.0, noise(5e-4), noise(5e-4), noise(5e-4)).normalized();
    state.v_WB = noise3(0.01);
    state.w_WB_B = noise3(0.01);
    for (int j = 0; j < kNumLegJoints; ++j) {
      state.q[j] = 0.4 * std::sin(time_ + j);
      state.qd[j] = noise(0.1);
      state.torque[j] = 12.0 * std::sin(0.7 * j + 2.0 * time_) + noise(0.2) - 0.9 * j * a;
    }
    tick.reading.q = state.q;
    tick.reading.torque = state.torque;
    tick.reading.gyro = state.w_WB_B;
    tick.reading.accelerometer = Vec3(0.0, 0.0, kGravity) + noise3(0.02);
  }

  void model_and_truth() {
    const Vec3 com(tick.plan.com.p.x() + noise(4e-5) + 1e-4 * std::sin(9.0 * time_),
                   tick.plan.com.p.y() + noise(4e-5), 0.47);
    tick.model.p_WCom = truth.p_SCom = com;
    truth.time = time_;
    truth.p_SB = tick.state.p_WB;
    truth.q_SB = tick.state.q_WB;
    truth.q = tick.state.q;
    truth.qd = tick.state.qd;
    truth.torque = tick.state.torque;
    truth.qpos.assign(19, time_);
    truth.qvel.assign(18, noise(1.0));
    truth.ctrl.assign(12, noise(1.0));
    truth.xfrc_applied.assign(84, 30.0 * std::sin(time_));
    for (const Leg leg : kLegs) {
      const std::size_t k = index(leg);
      const Vec3 p_BH(is_front(leg) ? 0.34 : -0.34, is_left(leg) ? 0.19 : -0.19, 0.0);
      const bool contact = tick.plan.contact(leg);
      tick.model.p_WF[k] = truth.p_SF[k] = tick.plan.feet[k].p_WF + noise3(1e-4);
      tick.model.p_WH[k] = truth.p_SB + truth.q_SB * p_BH;
      tick.model.force[k] =
          contact ? Vec3(noise(2.0), noise(2.0), 90.0 + noise(2.0)) : Vec3::Zero().eval();
      truth.feet[k] = {.touching = contact, .force = tick.model.force[k], .friction = 0.8};
      truth.feet[k].point = truth.p_SF[k] - Vec3(0.0, 0.0, 0.031);
      tick.state.foot_force[k] = tick.model.force[k];
    }
  }

  void hierarchy() {
    HierarchyReport& report = tick.hierarchy;
    report.num_levels = 11;
    report.num_active = 0;
    for (std::size_t i = 0; i < 11; ++i) {
      const double typical = std::pow(10.0, static_cast<double>(i) - 10.0);
      report.levels[i] = {.residual = typical * (1.0 + std::abs(noise(0.5))),
                          .degrees_of_freedom_left = static_cast<std::int32_t>(30 - 2 * i),
                          .iterations = 1,
                          .num_rows = 6,
                          .num_active = 0};
    }
    const double a = adaptation();
    const auto activate = [&](int level, int id) {
      report.active[static_cast<std::size_t>(report.num_active++)] = {
          static_cast<std::int16_t>(level), 3, id, 0.3 * a};
      ++report.levels[static_cast<std::size_t>(level)].num_active;
    };
    if (a > 0.2) activate(6, 1);
    if (a > 0.8) activate(6, 2);
    if (std::sin(3.0 * time_) > 0.9) activate(3, 1);
    report.levels[8].residual += 2.0 * a * a * a;
    report.levels[9].residual += 8.0 * a;
    report.num_missed = a > 0.5 ? 2 : 0;
    report.missed[0] = {9, 2, -8.0 * a};
    report.missed[1] = {8, 0, 2.0 * a * a * a};
    report.blocking_is_known = true;
    report.borderline = a > 0.5;
    report.num_blocking = a > 0.2 ? 1 : 0;
    report.blocking[0] = {9, 6, 1, 3.0 * a, 8.0 * a};
    report.level_switch = {};
    if (tick_ % 40 == 3) {
      report.level_switch = {.begins = true, .duration = 0.1 / 3.0, .change = {}};
      report.level_switch.change[7] = LevelChange::goes;
      report.level_switch.change[9] = LevelChange::comes;
    }
    report.transition_share = tick_ % 40 > 3 && tick_ % 40 < 17 ? tick_ % 40 / 17.0 : 1.0;
  }

  void command() {
    tick.command.time = time_;
    tick.command.torque = tick.state.torque;
    tick.command.mode = CommandMode::optimal;
  }

  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  double step_time_;
  double time_ = 0.0;
  int tick_ = 0;
};

}  // namespace surefoot::test
