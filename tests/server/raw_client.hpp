#pragma once

#include <cstdint>
#include <string>

namespace surefoot::test {

/// A connection to a server on loopback, byte by byte: what no well-behaved client would send, too.
class RawClient {
 public:
  /// `receive_buffer` [bytes]: of the system; 0: the usual.
  explicit RawClient(std::uint16_t port, int receive_buffer = 0);
  ~RawClient();
  RawClient(const RawClient&) = delete;
  RawClient& operator=(const RawClient&) = delete;

  /// False once the server has closed.
  bool send(const std::string& bytes) const;
  /// What comes next, at most `most` bytes; empty at the end, or where nothing comes for 5 s.
  [[nodiscard]] std::string receive(std::size_t most = 65536) const;
  /// Everything until the server closes, or nothing comes for 5 s.
  [[nodiscard]] std::string receive_all() const;
  /// One HTTP answer, with its body.
  [[nodiscard]] std::string answer();

  /// Asks for an upgrade at /api/live; the status of the answer.
  int upgrade(const std::string& host, const std::string& origin);
  /// A text message, masked as a client must.
  bool say(const std::string& text) const;
  /// The next message after an upgrade; empty at the end. `opcode` is 1 for a text, 2 for a block,
  /// 8 where the server closes.
  [[nodiscard]] std::string hear(int& opcode);
  /// The next text.
  [[nodiscard]] std::string hear_text();

 private:
  [[nodiscard]] bool fill(std::size_t count);

  int socket_;
  std::string received_;
};

/// A masked frame.
[[nodiscard]] std::string client_frame(int opcode, const std::string& content);

/// The status of an HTTP answer; 0 for what is none.
[[nodiscard]] int status_of(const std::string& answer);

}  // namespace surefoot::test
