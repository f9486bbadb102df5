#pragma once

#include "surefoot/logging/hierarchy_namer.hpp"
#include "surefoot/logging/log_header.hpp"
#include "surefoot/logging/partial_log.hpp"
#include "surefoot/signals/tick_record.hpp"

#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace surefoot::logging {

struct RecorderOptions {
  std::size_t queue_ticks = 256;  ///< ticks that may wait for the writer
};

/// Writes a run into an MCAP file (docs/log.md), on its own thread. `record` copies into a bounded
/// queue; if it is full, `record` waits, so that a recorded simulation is complete. The recorder's
/// thread encodes and compresses.
///
/// The file is `PATH.partial`, with one recorder at a time, until `close` renames it: a file called
/// PATH is complete. Two runs with the same seed and build differ only after the last tick, in the
/// timings and the summary.
///
/// Every call throws FileError, with the file's name, once it could not be written.
class Recorder {
 public:
  /// Identifies an added channel.
  using Channel = int;
  /// Appends a message to its argument.
  using Encode = std::function<void(std::string&)>;

  /// Throws FileError for a path that does not end with .mcap, which may be another file of the
  /// user's, and, with the other process, while another recorder writes to the same path.
  Recorder(std::string path, LogHeader header, RecorderOptions options = {});
  /// Without `close`: completes the ticks so far to a readable file, still named `.partial`.
  ~Recorder();

  void record(const TickRecord& tick);
  /// Kept until `close`, and written last.
  void record(const TickTiming& timing);

  /// Sets the names of levels and rows from the next tick on, for another stack.
  void rename(LevelNames names);

  /// Adds a channel for other messages, before the first tick. `schema` is a JSON schema.
  [[nodiscard]] Channel add_channel(std::string_view topic, std::string_view schema_name,
                                    std::string schema);
  /// Adds a message to it; `encode` is called on the recorder's thread.
  void record(Channel channel, double time, Encode encode);

  /// Writes all waiting messages, the timings and the summary (JSON), and renames the file.
  void close(std::string_view summary = "{}");
  /// The same for a cut-off run: the file is complete and keeps its `.partial` name.
  void close_partial(std::string_view summary);

  [[nodiscard]] const std::string& path() const { return path_; }
  /// Of the robot, for the schemas of added channels.
  [[nodiscard]] int num_legs() const;

 private:
  struct Implementation;
  /// Returns the implementation, which still holds the file's lock.
  [[nodiscard]] std::unique_ptr<Implementation> finish(std::string_view summary);

  std::string path_;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace surefoot::logging
