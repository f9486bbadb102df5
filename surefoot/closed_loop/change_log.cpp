#include "surefoot/closed_loop/change_log.hpp"

#include "surefoot/closed_loop/run_log.hpp"
#include "surefoot/logging/message_codec.hpp"

namespace surefoot::closed_loop {

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
