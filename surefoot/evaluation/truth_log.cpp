#include "surefoot/evaluation/truth_log.hpp"

#include "surefoot/evaluation/truth_fields.hpp"
#include "surefoot/logging/message_codec.hpp"

namespace surefoot::evaluation {

TruthLog::TruthLog(logging::Recorder& recorder)
    : recorder_(recorder),
      channel_(recorder.add_channel("/truth", "surefoot.GroundTruth",
                                    logged::schema<simulation::GroundTruth>(
                                        "surefoot.GroundTruth", "", recorder.num_legs()))) {}

void TruthLog::record(const simulation::GroundTruth& truth) {
  recorder_.record(channel_, truth.time, [truth](std::string& out) { logged::encode(truth, out); });
}

}  // namespace surefoot::evaluation
