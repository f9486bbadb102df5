#include "tests/server/raw_client.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <stdexcept>

namespace surefoot::test {
namespace {

constexpr int kWait = 5;  // for bytes [s]

std::size_t body_size(const std::string& head) {
  const std::size_t found = head.find("Content-Length: ");
  return found == std::string::npos ? 0 : std::stoul(head.substr(found + 16));
}

}  // namespace

RawClient::RawClient(std::uint16_t port, int receive_buffer)
    : socket_(socket(AF_INET, SOCK_STREAM, 0)) {
  if (receive_buffer > 0) {
    setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &receive_buffer, sizeof(receive_buffer));
  }
  timeval wait{.tv_sec = kWait, .tv_usec = 0};
  setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &wait, sizeof(wait));
  setsockopt(socket_, SOL_SOCKET, SO_SNDTIMEO, &wait, sizeof(wait));
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof(address)) != 0) {
    close(socket_);
    throw std::runtime_error("no connection to port " + std::to_string(port));
  }
}

RawClient::~RawClient() { close(socket_); }

bool RawClient::send(const std::string& bytes) const {
  for (std::size_t sent = 0; sent < bytes.size();) {
    const ssize_t now = ::send(socket_, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
    if (now <= 0) return false;
    sent += static_cast<std::size_t>(now);
  }
  return true;
}

std::string RawClient::receive(std::size_t most) const {
  std::string bytes(most, '\0');
  const ssize_t count = recv(socket_, bytes.data(), bytes.size(), 0);
  bytes.resize(static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
  return bytes;
}

std::string RawClient::receive_all() const {
  std::string all;
  for (std::string some = receive(); !some.empty(); some = receive()) all += some;
  return all;
}

bool RawClient::fill(std::size_t count) {
  while (received_.size() < count) {
    const std::string some = receive();
    if (some.empty()) return false;
    received_ += some;
  }
  return true;
}

std::string RawClient::answer() {
  std::size_t end = std::string::npos;
  while ((end = received_.find("\r\n\r\n")) == std::string::npos) {
    if (!fill(received_.size() + 1)) return received_;
  }
  const std::size_t size = end + 4 + body_size(received_.substr(0, end + 2));
  if (!fill(size)) return received_;
  const std::string answer = received_.substr(0, size);
  received_.erase(0, size);
  return answer;
}

int RawClient::upgrade(const std::string& host, const std::string& origin) {
  send("GET /api/live HTTP/1.1\r\nHost: " + host +
       "\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n" +
       (origin.empty() ? "" : "Origin: " + origin + "\r\n") +
       "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n");
  return status_of(answer());
}

bool RawClient::say(const std::string& text) const { return send(client_frame(1, text)); }

std::string RawClient::hear(int& opcode) {
  opcode = 8;
  if (!fill(2)) return "";
  opcode = received_[0] & 0x0F;
  std::size_t size = static_cast<unsigned char>(received_[1]) & 0x7FU, head = 2;
  const std::size_t bytes = size == 126 ? 2 : size == 127 ? 8 : 0;
  if (!fill(head + bytes)) return "";
  if (bytes > 0) size = 0;
  for (std::size_t i = 0; i < bytes; ++i) {
    size = (size << 8U) | static_cast<unsigned char>(received_[head + i]);
  }
  head += bytes;
  if (!fill(head + size)) return "";
  const std::string content = received_.substr(head, size);
  received_.erase(0, head + size);
  return content;
}

std::string RawClient::hear_text() {
  for (int opcode = 0; opcode != 8;) {
    const std::string content = hear(opcode);
    if (opcode == 1) return content;
  }
  return "";
}

std::string client_frame(int opcode, const std::string& content) {
  std::string frame(1, static_cast<char>(0x80 | opcode));
  const std::size_t size = content.size();
  if (size < 126) {
    frame += static_cast<char>(0x80 | size);
  } else {
    frame += static_cast<char>(0x80 | (size < 65536 ? 126 : 127));
    for (int shift = size < 65536 ? 8 : 56; shift >= 0; shift -= 8) {
      frame += static_cast<char>((size >> static_cast<unsigned>(shift)) & 0xFFU);
    }
  }
  return frame + std::string(4, '\0') + content;  // a mask of zeros
}

int status_of(const std::string& answer) {
  return answer.starts_with("HTTP/1.1 ") ? std::stoi(answer.substr(9, 3)) : 0;
}

}  // namespace surefoot::test
