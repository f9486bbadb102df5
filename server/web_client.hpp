#pragma once

#include "server/web_guard.hpp"
#include "server/web_server.hpp"

#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/beast/websocket.hpp>

#include <deque>
#include <functional>
#include <memory>
#include <set>
#include <string>

namespace surefoot::server {

class WebClient;

/// Shared by the connections of a server, all on its thread.
struct WebShared {
  const WebServerOptions& options;
  WebContent& content;
  const OwnNames& names;
  /// Sends due news to watching pages, before another request is answered.
  std::function<void()> catch_up;
  std::set<std::shared_ptr<WebClient>> clients{};  ///< that watch live
  // Shared, since counts may outlive the server.
  /// All connections.
  std::shared_ptr<std::size_t> connections = std::make_shared<std::size_t>(0);
  /// Answers on their way [bytes].
  std::shared_ptr<std::size_t> answers = std::make_shared<std::size_t>(0);
};

/// Adds an amount to a count while it lives: a connection, or the bytes of an answer.
class Count {
 public:
  explicit Count(std::shared_ptr<std::size_t> all, std::size_t amount = 1)
      : all_(std::move(all)), amount_(amount) {
    *all_ += amount_;
  }
  ~Count() { *all_ -= amount_; }
  Count(const Count&) = delete;
  Count& operator=(const Count&) = delete;

 private:
  std::shared_ptr<std::size_t> all_;
  std::size_t amount_;
};

/// A page that watches live, over WebSocket. Its queue is bounded: the oldest frames are dropped
/// and counted.
class WebClient : public std::enable_shared_from_this<WebClient> {
 public:
  using Request = boost::beast::http::request<boost::beast::http::empty_body>;

  WebClient(boost::beast::tcp_stream&& stream, WebShared& shared, std::shared_ptr<Count> count);

  /// Accepts the upgrade; if all places are taken, it closes with that reason.
  void begin(const Request& request);
  void send(const SharedBlock& block);
  void send(std::shared_ptr<const std::string> text);
  /// Replaces a status that still waits, if no other text followed it. Texts go before waiting
  /// frames.
  void send_status(std::shared_ptr<const std::string> status);
  void close();

 private:
  enum class Kind { block, text, status };
  struct Message {
    Kind kind;
    std::uint32_t frames, generation;
    std::shared_ptr<const std::string> bytes;
  };

  void enter();
  void turn_away();
  /// Closes with a reason.
  void part(const boost::beast::websocket::close_reason& reason);
  void read();
  void take(std::string_view text);
  void reply(std::int64_t id, const std::string& error, bool is_token_known = true);
  void put(Message message);
  [[nodiscard]] std::deque<Message>::iterator place_of(Kind kind);
  void drop_oldest_block();
  void write_next();
  void leave();

  boost::beast::websocket::stream<boost::beast::tcp_stream> socket_;
  WebShared& shared_;
  std::shared_ptr<Count> count_;
  boost::beast::flat_buffer received_;
  std::deque<Message> waiting_;  // the first is being written if `writing_`
  std::size_t waiting_bytes_ = 0;
  std::array<char, kBlockHeadBytes> head_{};  // of the block that is being written
  bool open_ = false, writing_ = false, closing_ = false;
  std::uint32_t dropped_ = 0;
  RateLimit rate_;
};

}  // namespace surefoot::server
