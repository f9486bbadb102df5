#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace surefoot::server {

/// Explains ticks of a log on its own thread, since that takes as long as a replay up to the tick.
/// A new request replaces one that waits.
class TickExplainer {
 public:
  /// `period`: of the log's ticks [s].
  TickExplainer(std::string path, double period);
  ~TickExplainer();
  TickExplainer(const TickExplainer&) = delete;
  TickExplainer& operator=(const TickExplainer&) = delete;

  /// `gave_way_json` of a tick with exact costs, or a `problem`. None: not yet.
  [[nodiscard]] std::optional<std::string> ask(std::uint32_t tick);

 private:
  void run();
  [[nodiscard]] std::string explained(std::uint32_t tick) const;

  const std::string path_;
  const double period_;
  std::mutex mutex_;
  std::condition_variable wakes_;
  std::map<std::uint32_t, std::string> known_;
  std::optional<std::uint32_t> wanted_;
  std::atomic<bool> stopping_ = false;
  std::thread thread_;
};

}  // namespace surefoot::server
