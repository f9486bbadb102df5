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

namespace surefoot::logging {

/// Decodes a message with a signal of the tick (all of a tick but its hierarchy); false for other
/// messages. Throws JsonError if the message does not fit its schema.
[[nodiscard]] bool decode_signal(const McapMessage& message, const LogRobot& robot,
                                 TickRecord& tick);

/// Reads a recorder's log tick by tick, and skips unreadable parts of cut-off or damaged logs.
class LogReader {
 public:
  /// Level and id of an inequality row.
  using RowKey = std::pair<std::int16_t, std::int32_t>;
  using Other = std::function<void(const McapMessage&)>;

  /// Throws FileError if the file is missing, empty, not MCAP, not a log of ours or of another
  /// version. `other` gets the messages on other than the recorder's own channels, such as /truth,
  /// in their order.
  explicit LogReader(const std::string& path, Other other = {});

  /// The recorder's header, without `row_name`.
  [[nodiscard]] const LogHeader& header() const { return header_; }

  /// Skips the ticks before a time [s], without decoding; call before the first `next`. Messages on
  /// other channels still arrive.
  void skip_until(double time);

  /// The next complete tick; false after the last one. Throws FileError if a message does not fit
  /// its schema.
  [[nodiscard]] bool next(TickRecord& tick);

  /// Levels of the last tick, highest first, as numbers in the header. The record always has them
  /// by these numbers.
  [[nodiscard]] const std::vector<std::int16_t>& level_order() const { return level_order_; }

  /// After the last tick.
  [[nodiscard]] const std::vector<TickTiming>& timings() const { return timings_; }
  /// After the last tick: the summary given to the recorder on closing, as JSON; empty without one.
  [[nodiscard]] std::string summary() const;
  /// Names of the active, missed and blocking rows in the ticks read so far.
  [[nodiscard]] const std::map<RowKey, std::string>& row_names() const { return row_names_; }
  [[nodiscard]] bool complete() const { return file_.complete(); }
  [[nodiscard]] std::string problem() const { return file_.problem(); }

  /// Is the last tick the run's first, or one control period after the one before, so that none in
  /// between is lost?
  [[nodiscard]] bool follows() const { return clock_.follows(); }
  /// Of the ticks read so far.
  [[nodiscard]] const ClockSkips& clock_skips() const { return clock_.skips(); }
  /// After the last tick: may later ticks be lost?
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

}  // namespace surefoot::logging
