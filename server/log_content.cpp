#include "server/log_content.hpp"

#include "server/view_tasks.hpp"
#include "server/web_answer.hpp"
#include "server/web_guard.hpp"
#include "surefoot/base/error.hpp"
#include "surefoot/config/data_directory.hpp"
#include "surefoot/config/stack_text.hpp"
#include "surefoot/explain/outcome.hpp"
#include "surefoot/logging/applied_force.hpp"
#include "surefoot/logging/log_reader.hpp"
#include "surefoot/replay/log_replay.hpp"

#include <algorithm>
#include <filesystem>

namespace surefoot::server {
namespace {

constexpr std::uint64_t kMostDecoded = 4096;   // ticks read for an answer
constexpr std::uint64_t kMostCompared = 2048;  // ticks compared for an answer

std::string urdf_of(const logging::LogHeader& header) {
  const std::string* urdf = header.attachment("robot.urdf");
  return urdf == nullptr ? "" : *urdf;
}

/// A block of what `pack_at` appends for each of `count` ticks, as many frames as it returns.
std::string block(const FrameRequest& asked, std::uint32_t count, std::uint32_t end_tick,
                  auto&& pack_at) {
  std::string bytes(kBlockHeadBytes, '\0');
  std::uint32_t frames = 0;
  std::uint64_t tick = asked.from;
  for (std::uint32_t i = 0; i < count && tick < end_tick; ++i, tick += asked.stride) {
    frames += pack_at(static_cast<std::uint32_t>(tick), bytes);
  }
  std::ranges::copy(packed({.frames = frames, .dropped = 0, .generation = 0}), bytes.begin());
  return bytes;
}

/// Why the run of a complete file does not end where it should; empty: it does.
std::string cut_of(const explain::Outcome& outcome) {
  if (!outcome.known)
    return "how the run ended is not known: the log's file is whole, but has no summary";
  if (!outcome.interrupted) return "";
  return "the run was " + outcome.reason + ": the log's file is whole, and ends there";
}

}  // namespace

LogContent::LogContent(const std::string& path)
    : LogContent(path, logging::LogReader(path).header()) {}

LogContent::LogContent(const std::string& path, const logging::LogHeader& header)
    : frames_(path, header),
      summary_(path, header),
      robot_(urdf_of(header), {.packages = config::package_directories(), .urdf = {}}),
      explainer_(path, frames_.period()) {
  describe(path, header);
  const std::string missing = missing_meshes_text(session_.meshes);
  if (!missing.empty()) notes_.push_back(missing);
  if (!session_.cut.empty()) notes_.push_back(session_.cut);
}

void LogContent::describe(const std::string& path, const logging::LogHeader& header) {
  session_.start = random_token();
  session_.mode = "replay";
  session_.version = header.version;
  session_.title =
      header.scenario + (header.seed == 0 ? "" : ", seed " + std::to_string(header.seed));
  session_.source = std::filesystem::path(path).filename().string();
  if (!frames_.complete()) {
    session_.cut = std::string(kNeverClosed) + " (at byte " + std::to_string(frames_.end_byte()) +
                   "): what is left of it is shown";
  } else {
    const explain::Outcome outcome = explain::read_outcome(frames_.outcome());
    session_.cut = cut_of(outcome);
    session_.ended = outcome.known ? outcome.reason : "";
  }
  session_.header = to_json(header);
  session_.period = header.control_period;
  session_.first_tick = frames_.first_tick();
  session_.ticks = frames_.end_tick() - frames_.first_tick();
  session_.channels = frames_.channels();
  session_.meshes = robot_.meshes();
  session_.orders = {{0, header.level_names}};
  session_.bodies = logging::body_names(header);
  if (!session_.bodies.empty()) session_.bodies.erase(session_.bodies.begin());  // the world
  try {
    const replay::LogReplay replay(path);
    session_.rows = replay.controller().row_names();
    session_.tasks = view_tasks(config::with_defaults(replay.options().stack), header.level_names);
  } catch (const Error& error) {
    notes_.push_back("rows have no names in the page: " + std::string(error.what()));
  }
}

WebAnswer LogContent::get(std::string_view path, const Query& query) {
  if (path == "/api/session") return {200, "application/json", session()};
  if (path == "/api/events") return {200, "application/json", summary_.events_json()};
  if (path == "/api/explain") return explained(query);
  if (path != "/api/frames") return robot_.get(path);
  return answer_frames(query, [this](const FrameRequest& asked) {
    return asked.min_max ? ranges(asked) : frames(asked);
  });
}

WebAnswer LogContent::explained(const Query& query) {
  if (!query.contains("tick")) return refusal(400, "tick is missing: the number of a tick");
  std::uint32_t tick = 0;
  try {
    read_number(query, "tick", frames_.first_tick(), frames_.end_tick() - 1, tick);
  } catch (const Error& error) {
    return refusal(400, error.what());
  }
  const std::optional<std::string> answer = explainer_.ask(tick);
  return {answer ? 200 : 202, "application/json", answer.value_or("null")};
}

std::string LogContent::session() {
  ViewSession session = session_;
  session.summarised = std::max(summary_.end_tick(), session.first_tick) - session.first_tick;
  session.damage = summary_.damage();
  for (ViewOrder& order : summary_.orders()) session.orders.push_back(std::move(order));
  return to_json(session);
}

// A long span comes from the summary, each of its frames once.
std::string LogContent::frames(const FrameRequest& asked) {
  const bool is_long = (asked.count - 1) * std::uint64_t{asked.stride} >= kMostDecoded;
  ViewFrame kept;
  std::optional<std::uint32_t> last;
  return block(asked, asked.count, frames_.end_tick(), [&](std::uint32_t tick, std::string& bytes) {
    if (is_long && !summary_.frame_near(tick, kept)) return 0U;
    const ViewFrame* frame = is_long ? &kept : frames_.frame(tick);
    if (frame == nullptr || last == frame->tick) return 0U;
    last = frame->tick;
    pack(*frame, bytes);
    return 1U;
  });
}

// Two frames a stride, from the ticks themselves where the summary is too coarse.
std::string LogContent::ranges(const FrameRequest& asked) {
  const std::uint32_t count = asked.count / 2 + asked.count % 2;
  const bool is_fine = asked.stride < summary_.stretch() &&
                       std::uint64_t{asked.count / 2} * asked.stride <= kMostCompared;
  return block(asked, count, frames_.end_tick(), [&](std::uint32_t first, std::string& bytes) {
    const std::uint32_t last = first + asked.stride - 1;
    if (!(is_fine ? range(first, last) : summary_.range(first, last, range_))) return 0U;
    range_.pack(first, first * frames_.period(), bytes);
    return 2U;
  });
}

bool LogContent::range(std::uint32_t first, std::uint32_t last) {
  range_.clear(frames_.channels().floats);
  bool known = false;
  for (std::uint32_t tick = first; tick <= last && tick < frames_.end_tick(); ++tick) {
    const ViewFrame* frame = frames_.frame(tick);
    if (frame == nullptr) continue;
    known = true;
    range_.add(frame->floats);
  }
  return known;
}

}  // namespace surefoot::server
