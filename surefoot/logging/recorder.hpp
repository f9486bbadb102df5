#pragma once

#include "surefoot/logging/hierarchy_namer.hpp"
#include "surefoot/logging/log_header.hpp"
#include "surefoot/logging/partial_log.hpp"
#include "surefoot/signals/tick_record.hpp"

#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace surefoot {

struct RecorderOptions {
  std::size_t queue_ticks = 256;  ///< ticks that wait for the writer before `record` waits
};

/// Writes a run into an MCAP file (docs/log.md), on a thread of its own. `record` copies into a
/// bounded queue; when it is full it waits for the writer, so that a recorded simulation is
/// complete. Encoding and compression happen on the recorder's thread.
///
/// The file is written as `PATH.partial`, by one recorder at a time, and gets its name in `close`:
/// what is called PATH is whole. Two runs with the same seed and build differ only after the last
/// tick, in the timings and the summary.
///
/// Every call throws FileError, naming the file, once it could not be written.
class Recorder {
 public:
  /// Identifies a channel that was added.
  using Channel = int;
  /// Appends a message to its argument.
  using Encode = std::function<void(std::string&)>;

  /// Throws FileError, naming the process, while another records to the same path.
  Recorder(std::string path, LogHeader header, RecorderOptions options = {});
  /// Without a `close` before: the ticks so far are completed to a readable file, still named
  /// `.partial`.
  ~Recorder();

  void record(const TickRecord& tick);
  /// Kept until `close`; written after everything else.
  void record(const TickTiming& timing);

  /// The names of levels and rows from the next tick on, where the stack is another one.
  void rename(LevelNames names);

  /// A channel of somebody else's messages, before the first tick. `schema` is a JSON schema.
  [[nodiscard]] Channel add_channel(std::string_view topic, std::string_view schema_name,
                                    std::string schema);
  /// A message for it; `encode` is called on the recorder's thread.
  void record(Channel channel, double time, Encode encode);

  /// Writes everything that waits, the timings and the summary (JSON), and gives the file its name.
  void close(std::string_view summary = "{}");
  /// The same for a run that was cut off: the file is whole as a file, and keeps the name that says
  /// that the run is not.
  void close_partial(std::string_view summary);

  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  struct Implementation;
  /// What holds the lock of the file, which is whole.
  [[nodiscard]] std::unique_ptr<Implementation> finish(std::string_view summary);

  std::string path_;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace surefoot
