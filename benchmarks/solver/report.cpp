#include "benchmarks/solver/report.hpp"

#include <array>
#include <cstdarg>
#include <cstdio>

namespace surefoot::benchmarks {
namespace {

[[gnu::format(printf, 1, 2)]] std::string print(const char* format, ...) {
  std::array<char, 256> text{};
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text.data(), text.size(), format, arguments);
  va_end(arguments);
  return text.data();
}

double percent(int count, const PeerResult& peer) {
  return 100.0 * count / static_cast<double>(peer.problems);
}

}  // namespace

std::string table(const SetResult& result) {
  std::string text =
      print("\n%s: %d problems, %.1f active inequality rows on average; Q = %.2f µs\n",
            result.name.c_str(), result.problems, result.active, result.q);
  text += print("  %-26s %9s %9s %9s %8s %8s %9s %7s %7s %6s %5s %8s\n", "", "median", "p99", "max",
                "median", "p99", "x ours", "right", "1e-3", "failed", "hung", "allocs");
  text += print("  %-26s %9s %9s %9s %8s %8s %9s %7s %7s %6s %5s %8s\n", "solver", "us", "us", "us",
                "Q", "Q", "median", "%", "%", "", "", "a solve");
  const double ours = quantile(result.peers.front().times, 0.5);
  for (const PeerResult& peer : result.peers) {
    const double median = quantile(peer.times, 0.5), p99 = quantile(peer.times, 0.99);
    text += print("  %-26s %9.2f %9.2f %9.2f %8.3f %8.3f %9.2f %7.2f %7.2f %6d %5d %8.1f\n",
                  peer.peer.c_str(), median, p99, quantile(peer.times, 1.0), median / result.q,
                  p99 / result.q, median / ours, percent(peer.right, peer),
                  percent(peer.near, peer), peer.failed, peer.hung, peer.allocations);
  }
  return text;
}

nlohmann::ordered_json to_json(const SetResult& result) {
  nlohmann::ordered_json peers = nlohmann::ordered_json::array();
  for (const PeerResult& peer : result.peers) {
    peers.push_back({{"solver", peer.peer},
                     {"median_us", quantile(peer.times, 0.5)},
                     {"p99_us", quantile(peer.times, 0.99)},
                     {"max_us", quantile(peer.times, 1.0)},
                     {"right_percent", percent(peer.right, peer)},
                     {"near_percent", percent(peer.near, peer)},
                     {"failed", peer.failed},
                     {"hung", peer.hung},
                     {"allocations", peer.allocations}});
  }
  return {{"family", result.name},
          {"problems", result.problems},
          {"active_rows", result.active},
          {"q_us", result.q},
          {"solvers", std::move(peers)}};
}

}  // namespace surefoot::benchmarks
