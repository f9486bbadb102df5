#pragma once

#include "server/frame_block.hpp"
#include "server/view_command.hpp"

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace surefoot::server {

/// An answer to a request.
struct WebAnswer {
  int status = 200;
  std::string media_type = "text/plain; charset=utf-8";
  std::string body;
};

/// Frames for all clients, packed once.
struct SharedBlock {
  std::uint32_t frames = 0, generation = 0;
  std::uint32_t lost = 0;  ///< dropped ticks before it
  std::shared_ptr<const std::string> bytes;
};

/// Content of a server. All calls come from the server's thread.
class WebContent {
 public:
  using Query = std::map<std::string, std::string, std::less<>>;

  WebContent() = default;
  WebContent(const WebContent&) = delete;
  WebContent& operator=(const WebContent&) = delete;
  virtual ~WebContent() = default;

  /// Names this start of the program: another start serves something else.
  [[nodiscard]] virtual std::string start() const { return ""; }
  /// The answer for a path below /api/ other than `/api/alive`.
  [[nodiscard]] virtual WebAnswer get(std::string_view path, const Query& query) = 0;
  /// Whether there is a live run.
  [[nodiscard]] virtual bool is_live() const { return false; }
  /// The first frames for a new client.
  [[nodiscard]] virtual std::vector<SharedBlock> welcome() { return {}; }
  /// Frames since the last call, about 30 times a second.
  [[nodiscard]] virtual std::vector<SharedBlock> blocks() { return {}; }
  /// Messages for all clients since the last call; `clients`: how many there are.
  [[nodiscard]] virtual std::vector<std::string> messages(std::size_t clients) {
    static_cast<void>(clients);
    return {};
  }
  /// The status for a new client.
  [[nodiscard]] virtual std::string status(std::size_t clients) {
    static_cast<void>(clients);
    return "";
  }
  /// A page has drawn the robot for the first time.
  virtual void drawn() {}
  /// Takes a command with the right token. Returns what is wrong with it; empty: nothing.
  [[nodiscard]] virtual std::string command(const ViewCommand& command) {
    static_cast<void>(command);
    return "there is nothing to command";
  }
};

struct WebServerOptions {
  /// Address of this machine; empty: loopback, 127.0.0.1 and ::1. Another needs the user's token.
  std::string listen{};
  std::uint16_t port = 0;  ///< 0: any that is free
  std::string token{};     ///< for commands; empty: a random one
  int max_clients = 8;     ///< that watch live
};

/// Serves the viewer's page by HTTP and WebSocket (viewer/README.md), on its own thread. No
/// client can make others wait: what it does not read in time is dropped, and its requests are
/// limited in size, number and rate.
class WebServer {
 public:
  /// Throws Error, with advice, where it can't listen. `content` must outlive it.
  WebServer(const WebServerOptions& options, WebContent& content);
  ~WebServer();

  [[nodiscard]] std::uint16_t port() const;
  /// The link that opens the page, with the token.
  [[nodiscard]] std::string link() const;
  [[nodiscard]] const std::string& token() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace surefoot::server
