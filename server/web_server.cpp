#include "server/web_server.hpp"

#include "server/own_hosts.hpp"
#include "server/web_answer.hpp"
#include "server/web_client.hpp"
#include "surefoot/base/background.hpp"
#include "surefoot/base/error.hpp"

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/v6_only.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/http.hpp>

#include <algorithm>
#include <chrono>
#include <optional>
#include <thread>

namespace surefoot::server {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
using tcp = asio::ip::tcp;

constexpr std::uint32_t kLongestHeader = 8192;    // of a request [bytes]
constexpr std::size_t kExtraConnections = 32;     // in addition to those of pages
constexpr std::size_t kConnectionsOfPage = 8;     // of a browser to one host, and the live one
constexpr std::size_t kRefusedAtOnce = 32;        // that get an answer
constexpr std::size_t kMostAnswers = 128U << 20;  // on their way, for all clients [bytes]
constexpr std::chrono::seconds kRequestTime{15};  // to send a request, or the next one
constexpr std::chrono::seconds kAnswerTime{60};   // to take an answer
constexpr std::chrono::seconds kFinishTime{2};    // to discard input after the answer
constexpr std::chrono::milliseconds kBlockInterval{33};  // between blocks
constexpr std::chrono::milliseconds kNoRoom{100};        // pause before the next accept

/// An HTTP connection, until its upgrade.
class WebConnection : public std::enable_shared_from_this<WebConnection> {
 public:
  WebConnection(tcp::socket&& socket, WebShared& shared)
      : stream_(std::move(socket)),
        shared_(shared),
        count_(std::make_shared<Count>(shared.connections)) {}

  void read() {
    parser_.emplace();
    parser_->header_limit(kLongestHeader);
    stream_.expires_after(kRequestTime);
    http::async_read(stream_, buffer_, *parser_,
                     [self = shared_from_this()](beast::error_code error, std::size_t) {
                       self->received(error);
                     });
  }

  /// Refuses the connection instead of reading: there are too many.
  void refuse() {
    send(refusal(503, "too many connections; close some of the pages that are open"), false, false);
  }

 private:
  using Request = WebClient::Request;

  void received(beast::error_code error) {
    if (error == http::error::header_limit) {
      return send(refusal(431, "the request's header has more than 8192 bytes"), false, false);
    }
    if (error == http::error::unexpected_body) {
      return send(refusal(413, "a request has no body here"), false, false);
    }
    if (error.category() == http::make_error_code(http::error::end_of_stream).category() && error &&
        error != http::error::end_of_stream && error != http::error::partial_message) {
      return send(refusal(400, "not a request that can be read"), false, false);
    }
    if (error) return;
    const Request request = parser_->release();
    if (beast::websocket::is_upgrade(request)) return upgrade(request);
    const bool is_head = request.method() == http::verb::head;
    send(answer(request), request.keep_alive(), is_head);
  }

  /// The refusal of a request for another host, if it is one.
  [[nodiscard]] std::optional<WebAnswer> foreign_host(const Request& request) const {
    const auto host = std::string_view(request[http::field::host]);
    if (request.count(http::field::host) == 1 && shared_.names.has_host(host)) return std::nullopt;
    return refusal(421, "this server is not the host that was asked for; open http://" +
                            shared_.names.names().front() + "/");
  }

  /// The refusal of a page of another origin.
  [[nodiscard]] WebAnswer foreign_origin() const {
    return refusal(403, "a page of another origin may not watch; open http://" +
                            shared_.names.names().front() + "/");
  }

  /// Whether a browser asks for another page, also by an image or a link, which have no origin.
  [[nodiscard]] static bool is_of_another_site(const Request& request) {
    const auto site = std::string_view(request["Sec-Fetch-Site"]);
    return !site.empty() && site != "same-origin" && site != "none";
  }

  [[nodiscard]] WebAnswer answer(const Request& request) const {
    if (auto refused = foreign_host(request)) return *refused;
    if (request.method() != http::verb::get && request.method() != http::verb::head) {
      return refusal(405, "only GET and HEAD are known here");
    }
    const auto origin = std::string_view(request[http::field::origin]);
    if (request.count(http::field::origin) != 0 && !shared_.names.has_origin(origin)) {
      return foreign_origin();
    }
    const auto target = std::string_view(request.target());
    if (target.starts_with("/api/") && is_of_another_site(request)) return foreign_origin();
    if (*shared_.answers > kMostAnswers) {
      return refusal(503, "too much is on its way to those who asked before; ask again");
    }
    if (target == "/api/live") return refusal(426, "this is for a WebSocket");
    shared_.catch_up();
    return answer_for(target, shared_.content);
  }

  void upgrade(const Request& request) {
    const auto origin = std::string_view(request[http::field::origin]);
    std::optional<WebAnswer> refused = foreign_host(request);
    if (!refused && std::string_view(request.target()) != "/api/live") {
      refused = refusal(404, "a WebSocket is at /api/live");
    }
    if (!refused &&
        (request.count(http::field::origin) != 1 || !shared_.names.has_origin(origin))) {
      refused = foreign_origin();
    }
    if (!refused && !shared_.content.is_live()) {
      refused = refusal(404, "there is nothing live: a log is shown");
    }
    if (refused) return send(std::move(*refused), false, false);
    std::make_shared<WebClient>(std::move(stream_), shared_, count_)->begin(request);
  }

  void send(WebAnswer answer, bool keep_alive, bool is_head) {
    const auto response = std::make_shared<http::response<http::string_body>>();
    response->result(static_cast<unsigned>(answer.status));
    response->version(11);
    response->set(http::field::content_type, answer.media_type);
    for (const auto& [name, value] : kWebHeaders) response->set(name, value);
    response->keep_alive(keep_alive);
    const std::size_t size = answer.body.size();
    if (!is_head) response->body() = std::move(answer.body);
    response->content_length(size);
    stream_.expires_after(kAnswerTime);
    const auto weight = std::make_shared<Count>(shared_.answers, response->body().size());
    const auto done = [self = shared_from_this(), response, weight, keep_alive](
                          beast::error_code error, std::size_t) {
      if (error) return;
      if (keep_alive) return self->read();
      self->finish();
    };
    if (!is_head) return http::async_write(stream_, *response, done);
    const auto serializer =
        std::make_shared<http::response_serializer<http::string_body>>(*response);
    http::async_write_header(
        stream_, *serializer,
        [serializer, done](beast::error_code error, std::size_t sent) { done(error, sent); });
  }

  // Reads remaining input; otherwise closing could lose the answer.
  void finish() {
    beast::error_code ignored;
    stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
    stream_.expires_after(kFinishTime);
    discard();
  }

  void discard() {
    buffer_.clear();
    stream_.async_read_some(buffer_.prepare(kLongestHeader),
                            [self = shared_from_this()](beast::error_code error, std::size_t) {
                              if (!error) self->discard();
                            });
  }

  beast::tcp_stream stream_;
  WebShared& shared_;
  std::shared_ptr<Count> count_;
  beast::flat_buffer buffer_{2 * kLongestHeader};
  std::optional<http::request_parser<http::empty_body>> parser_;
};

WebServerOptions with_token(WebServerOptions options) {
  if (options.token.empty() && !options.listen.empty()) {
    throw Error("--listen " + options.listen +
                " needs --token TOKEN, a secret of your own of at least 16 letters and digits: "
                "others may reach that address, and the token alone keeps them from commanding");
  }
  if (options.token.empty()) options.token = random_token();
  check_token(options.token);
  return options;
}

asio::ip::address address_of(const std::string& text) {
  beast::error_code error;
  const asio::ip::address address = asio::ip::make_address(text, error);
  if (!error) return address;
  throw Error("--listen \"" + text +
              "\" is not an address; valid is one of this machine's, such as " +
              own_hosts(true).front());
}

}  // namespace

struct WebServer::Implementation {
  Implementation(const WebServerOptions& given, WebContent& content)
      : options(with_token(given)),
        port(listen()),
        names(hosts(), port),
        shared{options, content, names, [this] { catch_up(); }},
        timer(io) {
    for (tcp::acceptor& acceptor : acceptors) accept(acceptor);
    tick();
    thread = std::thread([this] { run(); });
  }

  ~Implementation() {
    io.stop();
    thread.join();
  }

  void run() {
    become_background("view-server");
    io.run();
  }

  std::uint16_t listen() {
    if (!options.listen.empty()) return open({address_of(options.listen), options.port});
    const std::uint16_t found = open({asio::ip::address_v4::loopback(), options.port});
    try {
      open({asio::ip::address_v6::loopback(), found});
    } catch (const Error&) {  // a machine without IPv6
      if (has_ipv6_loopback()) throw;
    }
    return found;
  }

  std::uint16_t open(const tcp::endpoint& endpoint) {
    beast::error_code error;
    tcp::acceptor acceptor(io);
    acceptor.open(endpoint.protocol(), error);
    if (!error) acceptor.set_option(asio::socket_base::reuse_address(true), error);
    if (!error && endpoint.address().is_v6()) {
      acceptor.set_option(asio::ip::v6_only(!endpoint.address().is_unspecified()), error);
    }
    if (!error) acceptor.bind(endpoint, error);
    if (!error) acceptor.listen(asio::socket_base::max_listen_connections, error);
    if (error) fail(endpoint, error);
    acceptors.push_back(std::move(acceptor));
    return acceptors.back().local_endpoint().port();
  }

  [[noreturn]] static void fail(const tcp::endpoint& endpoint, const beast::error_code& error) {
    const std::string port = std::to_string(endpoint.port());
    const std::string address = endpoint.address().to_string();
    if (error == asio::error::address_in_use) {
      throw Error("port " + port + " of " + address +
                  " is in use, perhaps by another run; end that, or take another port with --port "
                  "(0: any that is free)");
    }
    if (error == asio::error::access_denied) {
      throw Error("port " + port + " may not be used; valid is one from 1024 to 65535, or 0: any");
    }
    throw Error("can't listen on " + address + ", port " + port + ": " + error.message() +
                "; valid is an address of this machine");
  }

  [[nodiscard]] std::vector<std::string> hosts() const {
    if (options.listen.empty()) return {"127.0.0.1", "localhost", "[::1]"};
    const asio::ip::address address = address_of(options.listen);
    if (address.is_unspecified()) return own_hosts(address.is_v6());
    return {address.is_v6() ? "[" + address.to_string() + "]" : address.to_string()};
  }

  void accept(tcp::acceptor& acceptor) {
    acceptor.async_accept([this, &acceptor](beast::error_code error, tcp::socket socket) {
      if (error == asio::error::operation_aborted) return;
      if (error) return accept_later(acceptor);
      greet(std::move(socket));
      accept(acceptor);
    });
  }

  // Without free file descriptors each try would fail at once.
  void accept_later(tcp::acceptor& acceptor) {
    const auto wait = std::make_shared<asio::steady_timer>(io, kNoRoom);
    wait->async_wait([this, &acceptor, wait](beast::error_code error) {
      if (!error) accept(acceptor);
    });
  }

  void greet(tcp::socket&& socket) {
    const auto pages = static_cast<std::size_t>(options.max_clients);
    const std::size_t most = pages * kConnectionsOfPage + kExtraConnections;
    if (*shared.connections >= most + kRefusedAtOnce) return;  // closed
    const bool is_full = *shared.connections >= most;
    const auto connection = std::make_shared<WebConnection>(std::move(socket), shared);
    is_full ? connection->refuse() : connection->read();
  }

  void tick() {
    timer.expires_after(kBlockInterval);
    timer.async_wait([this](beast::error_code error) {
      if (error) return;
      broadcast();
      tick();
    });
  }

  // Many simultaneous requests must not delay the broadcast.
  void catch_up() {
    if (std::chrono::steady_clock::now() - broadcast_at >= kBlockInterval) broadcast();
  }

  void broadcast() {
    broadcast_at = std::chrono::steady_clock::now();
    const auto clients = shared.clients;  // a copy, since clients may leave meanwhile
    for (const SharedBlock& block : shared.content.blocks()) {
      for (const auto& client : clients) client->send(block);
    }
    for (std::string& message : shared.content.messages(clients.size())) {
      const bool is_status = message.starts_with(R"({"type":"status")");
      const auto text = std::make_shared<const std::string>(std::move(message));
      for (const auto& client : clients) is_status ? client->send_status(text) : client->send(text);
    }
  }

  const WebServerOptions options;
  asio::io_context io{1};
  std::vector<tcp::acceptor> acceptors;
  std::uint16_t port;
  OwnNames names;
  WebShared shared;
  asio::steady_timer timer;
  std::chrono::steady_clock::time_point broadcast_at = std::chrono::steady_clock::now();
  std::thread thread;
};

WebServer::WebServer(const WebServerOptions& options, WebContent& content)
    : implementation_(std::make_unique<Implementation>(options, content)) {}

WebServer::~WebServer() = default;

std::uint16_t WebServer::port() const { return implementation_->port; }

const std::string& WebServer::token() const { return implementation_->options.token; }

std::string WebServer::link() const {
  return "http://" + implementation_->names.names().front() + "/#token=" + token();
}

}  // namespace surefoot::server
