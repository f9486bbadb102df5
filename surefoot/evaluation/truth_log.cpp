#include "surefoot/evaluation/truth_log.hpp"

#include "surefoot/evaluation/truth_fields.hpp"
#include "surefoot/logging/message_codec.hpp"

namespace surefoot {

TruthLog::TruthLog(Recorder& recorder)
    : recorder_(recorder),
      channel_(recorder.add_channel("/truth", "surefoot.GroundTruth",
                                    logged::schema<GroundTruth>("surefoot.GroundTruth"))) {}

void TruthLog::record(const GroundTruth& truth) {
  recorder_.record(channel_, truth.time, [truth](std::string& out) { logged::encode(truth, out); });
}

}  // namespace surefoot
