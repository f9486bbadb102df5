#include "surefoot/view/report_figures.hpp"
#include "surefoot/view/time_figure.hpp"

#include <cmath>

// What the estimator believed against the simulator's truth.
namespace surefoot::report {
namespace {

constexpr double kDegrees = 180.0 / kPi;
constexpr double kMillimetres = 1e3;

/// NaN where something is not known, or the robot has stopped for good.
struct Errors {
  std::vector<double> tilt, velocity, position, heading;  // [°], [mm/s], [mm], [°]
};

/// The controller's W in the true one, by where base and heading were at a tick.
struct Start {
  Mat3 R = Mat3::Identity();
  Vec3 p = Vec3::Zero();
};

bool is_known(const TickSample& tick) {
  const bool has_stopped = tick.mode == CommandMode::sit || tick.mode == CommandMode::damping;
  return !has_stopped && !std::isnan(tick.truth.time) && tick.q_WB.coeffs().allFinite() &&
         tick.p_WB.allFinite() && tick.v_WB.allFinite();
}

double yaw(const Quat& q) {
  const Mat3 R = q.toRotationMatrix();
  return std::atan2(R(1, 0), R(0, 0));
}

double heading_error(const TickSample& tick) { return yaw(tick.q_WB) - yaw(tick.truth.q_WB); }

Start start_of(const TickSample& tick) {
  const Mat3 R = Eigen::AngleAxisd(-heading_error(tick), Vec3::UnitZ()).toRotationMatrix();
  return {R, tick.truth.p_WB - R * tick.p_WB};
}

double tilt_error(const TickSample& tick) {
  const Vec3 up = tick.q_WB.toRotationMatrix().row(2),
             true_up = tick.truth.q_WB.toRotationMatrix().row(2);
  return std::atan2(up.cross(true_up).norm(), up.dot(true_up));
}

double velocity_error(const TickSample& tick) {
  return (tick.q_WB.conjugate() * tick.v_WB - tick.truth.q_WB.conjugate() * tick.truth.v_WB).norm();
}

Errors errors_of(const RunData& run) {
  Errors errors;
  const TickSample* first = nullptr;
  Start start;
  for (const TickSample& tick : run.ticks) {
    const bool known = is_known(tick);
    if (known && first == nullptr) {
      first = &tick;
      start = start_of(tick);
    }
    errors.tilt.push_back(known ? kDegrees * tilt_error(tick) : kNaN);
    errors.velocity.push_back(known ? kMillimetres * velocity_error(tick) : kNaN);
    const Vec3 off = start.R * tick.p_WB + start.p - tick.truth.p_WB;
    errors.position.push_back(known ? kMillimetres * off.norm() : kNaN);
    const double turned = known ? heading_error(tick) - heading_error(*first) : kNaN;
    errors.heading.push_back(kDegrees * std::remainder(turned, 2.0 * kPi));
  }
  return errors;
}

}  // namespace

std::string estimate_figure(const RunData& run) {
  if (!run.has_truth || run.header.estimation == "truth") return "";
  std::vector<double> time;
  for (const TickSample& tick : run.ticks) time.push_back(tick.time);
  const auto panel = [](const char* title, const char* label, const char* style,
                        std::vector<double> values) {
    return plot::Panel{.title = title,
                       .y_label = label,
                       .curves = {{"", style, std::move(values)}},
                       .height = 96.0,
                       .from_zero = true};
  };
  Errors errors = errors_of(run);
  plot::Panel heading = panel("(d) heading, drift", "drift [°]", "line c2", errors.heading);
  heading.from_zero = false;
  return plot::draw(
      {.description = "Errors of the believed tilt, velocity, position and heading over time",
       .x = std::move(time),
       .x_range = time_range(run),
       .calibration = calibration_times(run),
       .panels = {panel("(a) tilt", "error [°]", "line c0", std::move(errors.tilt)),
                  panel("(b) velocity", "error [mm/s]", "line c3", std::move(errors.velocity)),
                  panel("(c) position, drift", "drift [mm]", "line c1", std::move(errors.position)),
                  std::move(heading)}});
}

}  // namespace surefoot::report
