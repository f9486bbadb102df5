#pragma once

#include "surefoot/logging/log_header.hpp"
#include "surefoot/logging/mcap_reader.hpp"
#include "surefoot/logging/tick_clock.hpp"
#include "surefoot/signals/tick_record.hpp"

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace surefoot {

/// Decodes a message that is a signal of the tick, which is all that a tick has but its hierarchy;
/// false where it is another. Throws JsonError where the message is not what its schema says.
[[nodiscard]] bool decode_signal(const McapMessage& message, TickRecord& tick);

/// Reads a recorder's log tick by tick, also one that was cut off or damaged: what can't be read is
/// passed over.
class LogReader {
 public:
  /// Level and id of an inequality row.
  using RowKey = std::pair<std::int16_t, std::int32_t>;
  using Other = std::function<void(const McapMessage&)>;

  /// Throws FileError if the file is missing, empty, not MCAP, not a log of ours or of another
  /// version.
  /// `other` gets the messages on channels that are not the recorder's own, such as /truth, as they
  /// come.
  explicit LogReader(const std::string& path, Other other = {});

  /// What the recorder was given, without `row_name`.
  [[nodiscard]] const LogHeader& header() const { return header_; }

  /// Passes over the ticks before a time [s], without decoding them; before the first `next`. What
  /// is on other channels still comes.
  void skip_until(double time);

  /// The next tick that is whole; false after the last one. Throws FileError if a message is not
  /// what its schema says.
  [[nodiscard]] bool next(TickRecord& tick);

  /// Of the last tick: its levels by their numbers in the header, highest first. In the record they
  /// stand by these numbers, whatever their order was.
  [[nodiscard]] const std::vector<std::int16_t>& level_order() const { return level_order_; }

  /// After the last tick.
  [[nodiscard]] const std::vector<TickTiming>& timings() const { return timings_; }
  /// After the last tick: the summary that the recorder was closed with, as JSON; empty without
  /// one.
  [[nodiscard]] std::string summary() const;
  /// Names of the rows that were active, missed or held something back in the ticks read so far.
  [[nodiscard]] const std::map<RowKey, std::string>& row_names() const { return row_names_; }
  [[nodiscard]] bool complete() const { return file_.complete(); }
  [[nodiscard]] std::string problem() const { return file_.problem(); }

  /// Whether the last tick is the first of the run or came a control period after the one before:
  /// none between them is lost.
  [[nodiscard]] bool follows() const { return clock_.follows(); }
  /// In the ticks read so far.
  [[nodiscard]] const ClockSkips& clock_skips() const { return clock_.skips(); }
  /// After the last tick: whether the run may have had more behind it, which are lost.
  [[nodiscard]] bool may_go_on() const;

 private:
  [[noreturn]] void refuse_without_header() const;
  bool take(const McapMessage& message, TickRecord& tick);
  [[nodiscard]] bool is_rest_of_lost_tick(const McapMessage& message);
  bool end_tick(std::uint64_t time);
  [[nodiscard]] std::uint64_t latest_timing() const;

  std::string path_;
  McapReader file_;
  Other other_;
  LogHeader header_;
  std::uint64_t skipped_until_ = 0;         // [ns]
  std::optional<std::uint64_t> tick_time_;  // of the last tick [ns]
  TickClock clock_{0.0};
  std::size_t known_losses_ = 0;
  bool in_lost_tick_ = false;
  std::vector<std::int16_t> level_order_;
  std::vector<TickTiming> timings_;
  std::map<RowKey, std::string> row_names_;
};

}  // namespace surefoot
