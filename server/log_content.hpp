#pragma once

#include "server/frame_range.hpp"
#include "server/frame_request.hpp"
#include "server/log_summary.hpp"
#include "server/tick_explainer.hpp"
#include "server/view_robot.hpp"
#include "server/web_server.hpp"

#include <string>

namespace surefoot::server {

/// Content for the pages of a log: the session, and frames on request.
class LogContent final : public WebContent {
 public:
  /// Throws FileError on a file that can't be shown.
  explicit LogContent(const std::string& path);

  [[nodiscard]] std::string start() const override { return session_.start; }
  [[nodiscard]] WebAnswer get(std::string_view path, const Query& query) override;

  /// Warnings for the user.
  [[nodiscard]] const std::vector<std::string>& notes() const { return notes_; }
  /// Sentences on what can't be read, as far as the log is summarised.
  [[nodiscard]] std::vector<std::string> damage() { return summary_.damage(); }

 private:
  LogContent(const std::string& path, const logging::LogHeader& header);
  void describe(const std::string& path, const logging::LogHeader& header);
  [[nodiscard]] std::string session();
  [[nodiscard]] WebAnswer explained(const Query& query);
  [[nodiscard]] std::string frames(const FrameRequest& asked);
  [[nodiscard]] std::string ranges(const FrameRequest& asked);
  [[nodiscard]] bool range(std::uint32_t first, std::uint32_t last);

  LogFrames frames_;
  LogSummary summary_;
  ViewRobot robot_;
  ViewSession session_;
  FrameRange range_;
  TickExplainer explainer_;
  std::vector<std::string> notes_;
};

}  // namespace surefoot::server
