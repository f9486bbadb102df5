#include "surefoot/closed_loop/change_log.hpp"

#include "surefoot/base/formatted.hpp"
#include "surefoot/closed_loop/run_log.hpp"
#include "surefoot/logging/message_codec.hpp"

namespace surefoot::closed_loop {

logged::Change push_change(const simulation::Push& push) {
  const Vec3& force = push.force;
  return {.time = push.time,
          .kind = "push",
          .text = formatted("push of %.3g N·s at ", force.norm() * push.duration) + push.body +
                  formatted(", force (%.3g, %.3g, %.3g) N for %.3g s", force.x(), force.y(),
                            force.z(), push.duration),
          .stack = {},
          .duration = push.duration,
          .body = push.body,
          .force = force};
}

ChangeLog::ChangeLog(logging::Recorder& recorder)
    : recorder_(recorder),
      channel_(recorder.add_channel("/changes", "surefoot.Change",
                                    logged::schema<logged::Change>("surefoot.Change"))) {}

void ChangeLog::record(const logged::Change& change, const control::Controller& controller) {
  recorder_.record(channel_, change.time,
                   [change](std::string& out) { logged::encode(change, out); });
  if (!change.stack.empty()) {
    recorder_.rename({controller.level_names(), row_namer(controller.row_names())});
  }
}

}  // namespace surefoot::closed_loop
