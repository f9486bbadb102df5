#include "surefoot/evaluation/truth_log.hpp"

#include "surefoot/evaluation/alignment_fields.hpp"
#include "surefoot/evaluation/truth_fields.hpp"
#include "surefoot/logging/message_codec.hpp"

namespace surefoot::evaluation {

TruthLog::TruthLog(logging::Recorder& recorder)
    : recorder_(recorder),
      truth_(recorder.add_channel("/truth", "surefoot.GroundTruth",
                                  logged::schema<simulation::GroundTruth>(
                                      "surefoot.GroundTruth", "", recorder.num_legs()))),
      alignment_(recorder.add_channel(
          "/alignment", "surefoot.Alignment",
          logged::schema<Alignment>("surefoot.Alignment", "", recorder.num_legs()))) {}

void TruthLog::record(const simulation::GroundTruth& truth, const TickRecord& tick) {
  const auto write = [this](logging::Recorder::Channel channel, const auto& message) {
    recorder_.record(channel, message.time,
                     [message](std::string& out) { logged::encode(message, out); });
  };
  write(truth_, truth);
  write(alignment_, aligner_.update(truth, tick));
}

}  // namespace surefoot::evaluation
