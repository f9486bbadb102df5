#include "server/web_client.hpp"

#include "surefoot/logging/json_text.hpp"

#include <boost/asio/buffer.hpp>

#include <algorithm>
#include <chrono>
#include <iterator>

namespace surefoot::server {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace websocket = beast::websocket;

constexpr std::size_t kLongestMessage = 4096;      // of a page [bytes]
constexpr double kMessagesPerSecond = 60.0;        // of a page
constexpr std::size_t kMostWaiting = 4U << 20U;    // for a slow page [bytes]
constexpr std::size_t kMostMessagesWaiting = 512;  // for a slow page
constexpr int kSendBuffer = 256 << 10;     // of the system, small, so that little is on the way
constexpr std::chrono::seconds kIdle{20};  // without an answer to a ping

}  // namespace

WebClient::WebClient(beast::tcp_stream&& stream, WebShared& shared, std::shared_ptr<Count> count)
    : socket_(std::move(stream)),
      shared_(shared),
      count_(std::move(count)),
      rate_(kMessagesPerSecond) {}

void WebClient::begin(const Request& request) {
  beast::get_lowest_layer(socket_).expires_never();
  beast::error_code ignored;
  beast::get_lowest_layer(socket_).socket().set_option(
      asio::socket_base::send_buffer_size(kSendBuffer), ignored);
  socket_.set_option(websocket::stream_base::timeout{.handshake_timeout = std::chrono::seconds(10),
                                                     .idle_timeout = kIdle,
                                                     .keep_alive_pings = true});
  socket_.read_message_max(kLongestMessage);
  socket_.auto_fragment(false);
  const auto most = static_cast<std::size_t>(std::max(shared_.options.max_clients, 0));
  const bool has_place = shared_.clients.size() < most;
  if (has_place) shared_.clients.insert(shared_from_this());
  socket_.async_accept(request, [self = shared_from_this(), has_place](beast::error_code error) {
    if (error) return self->leave();
    has_place ? self->enter() : self->turn_away();
  });
}

// After the upgrade, because a browser hides from its page why an upgrade was refused.
void WebClient::turn_away() {
  const int most = shared_.options.max_clients;
  const std::string watch =
      most == 1 ? "1 page watches already, the limit; close it"
                : std::to_string(most) + " pages watch already, the limit; close one of them";
  part({websocket::close_code::try_again_later, watch + ", or raise --view-clients"});
}

void WebClient::part(const websocket::close_reason& reason) {
  closing_ = true;
  socket_.async_close(reason, [self = shared_from_this()](beast::error_code) { self->leave(); });
}

void WebClient::enter() {
  open_ = true;
  for (const SharedBlock& block : shared_.content.welcome()) send(block);
  send_status(std::make_shared<std::string>(shared_.content.status(shared_.clients.size())));
  read();
}

void WebClient::read() {
  socket_.async_read(received_, [self = shared_from_this()](beast::error_code error, std::size_t) {
    if (error) return self->leave();
    if (!self->rate_.take(std::chrono::steady_clock::now())) {
      return self->part({websocket::close_code::policy_error, "more than 60 messages a second"});
    }
    const auto bytes = self->received_.cdata();
    self->take({static_cast<const char*>(bytes.data()), bytes.size()});
    self->received_.consume(self->received_.size());
    self->read();
  });
}

void WebClient::take(std::string_view text) {
  const ViewMessage message = read_message(text);
  if (!message.is_object) {
    reply(message.id, message.error);
  } else if (message.is_drawn) {
    shared_.content.drawn();
  } else if (!is_same_secret(message.token, shared_.options.token)) {
    reply(message.id, "commands need the token of the link that the program printed", false);
  } else if (!message.error.empty()) {
    reply(message.id, message.error);
  } else if (message.is_hello) {
    reply(message.id, "");
  } else {
    reply(message.id, shared_.content.command(message.command));
  }
}

void WebClient::reply(std::int64_t id, const std::string& error, bool is_token_known) {
  auto text = std::make_shared<std::string>();
  logging::JsonText json(*text);
  json.object().member("type", "reply").member("id", id).member("ok", error.empty());
  if (!error.empty()) json.member("error", std::string_view(error));
  if (!is_token_known) json.member("token", false);
  json.end_object();
  send(std::move(text));
}

void WebClient::send(const SharedBlock& block) {
  dropped_ += block.lost;
  put({Kind::block, block.frames, block.generation, block.bytes});
}

void WebClient::send(std::shared_ptr<const std::string> text) {
  put({Kind::text, 0, 0, std::move(text)});
}

// A new status does not overtake texts that followed the waiting one.
void WebClient::send_status(std::shared_ptr<const std::string> status) {
  const auto first = waiting_.begin() + (writing_ ? 1 : 0);
  const auto end = place_of(Kind::status);
  const bool is_renewed = end != first && std::prev(end)->kind == Kind::status;
  if (!is_renewed) return put({Kind::status, 0, 0, std::move(status)});
  const auto old = std::prev(end);
  waiting_bytes_ += status->size();
  waiting_bytes_ -= old->bytes->size();
  old->bytes = std::move(status);
}

void WebClient::put(Message message) {
  if (!open_ || closing_) return;
  waiting_bytes_ += message.bytes->size();
  waiting_.insert(place_of(message.kind), std::move(message));
  while (waiting_bytes_ > kMostWaiting) {
    const std::size_t before = waiting_bytes_;
    drop_oldest_block();
    if (waiting_bytes_ == before) break;
  }
  if (waiting_.size() > kMostMessagesWaiting) return close();
  if (!writing_) write_next();
}

// Texts go before waiting frames; otherwise a slow page would get replies late and its status
// never.
std::deque<WebClient::Message>::iterator WebClient::place_of(Kind kind) {
  if (kind == Kind::block) return waiting_.end();
  return std::find_if(waiting_.begin() + (writing_ ? 1 : 0), waiting_.end(),
                      [](const Message& message) { return message.kind == Kind::block; });
}

void WebClient::drop_oldest_block() {
  const auto first = waiting_.begin() + (writing_ ? 1 : 0);
  const auto oldest = std::find_if(
      first, waiting_.end(), [](const Message& message) { return message.kind == Kind::block; });
  if (oldest == waiting_.end()) return;
  dropped_ += oldest->frames;
  waiting_bytes_ -= oldest->bytes->size();
  waiting_.erase(oldest);
}

void WebClient::write_next() {
  if (waiting_.empty() || closing_) return;
  writing_ = true;
  const Message& message = waiting_.front();
  socket_.binary(message.kind == Kind::block);
  const auto done = [self = shared_from_this()](beast::error_code error, std::size_t) {
    self->writing_ = false;
    if (error) return self->leave();
    self->waiting_bytes_ -= self->waiting_.front().bytes->size();
    self->waiting_.pop_front();
    self->write_next();
  };
  const asio::const_buffer body = asio::buffer(*message.bytes);
  if (message.kind != Kind::block) return socket_.async_write(body, done);
  head_ = packed(BlockHead{message.frames, dropped_, message.generation});
  socket_.async_write(std::array<asio::const_buffer, 2>{asio::buffer(head_), body}, done);
}

void WebClient::close() {
  closing_ = true;
  beast::get_lowest_layer(socket_).close();
}

void WebClient::leave() {
  closing_ = true;
  shared_.clients.erase(shared_from_this());
}

}  // namespace surefoot::server
