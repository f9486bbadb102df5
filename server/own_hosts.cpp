#include "server/own_hosts.hpp"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netinet/in.h>

#include <algorithm>
#include <array>
#include <memory>

namespace surefoot::server {
namespace {

/// The address as in a link; empty: not an internet address.
std::string host_of(const sockaddr* address) {
  std::array<char, INET6_ADDRSTRLEN> text{};
  if (address == nullptr) return "";
  if (address->sa_family == AF_INET) {
    const auto* v4 = reinterpret_cast<const sockaddr_in*>(address);
    return inet_ntop(AF_INET, &v4->sin_addr, text.data(), text.size()) == nullptr ? ""
                                                                                  : text.data();
  }
  if (address->sa_family == AF_INET6) {
    const auto* v6 = reinterpret_cast<const sockaddr_in6*>(address);
    const char* shown = inet_ntop(AF_INET6, &v6->sin6_addr, text.data(), text.size());
    return shown == nullptr ? "" : "[" + std::string(shown) + "]";
  }
  return "";
}

}  // namespace

std::vector<std::string> own_hosts(bool with_ipv6) {
  ifaddrs* first = nullptr;
  if (getifaddrs(&first) != 0) first = nullptr;
  const std::unique_ptr<ifaddrs, void (*)(ifaddrs*)> all(first, [](ifaddrs* list) {
    if (list != nullptr) freeifaddrs(list);
  });
  std::vector<std::string> hosts, loopback;
  for (const ifaddrs* entry = first; entry != nullptr; entry = entry->ifa_next) {
    const std::string host = host_of(entry->ifa_addr);
    if (host.empty() || (host.starts_with('[') && !with_ipv6)) continue;
    ((entry->ifa_flags & IFF_LOOPBACK) != 0U ? loopback : hosts).push_back(host);
  }
  hosts.insert(hosts.end(), loopback.begin(), loopback.end());
  hosts.emplace_back("localhost");
  return hosts;
}

bool has_ipv6_loopback() {
  const std::vector<std::string> hosts = own_hosts(true);
  return std::ranges::find(hosts, "[::1]") != hosts.end();
}

}  // namespace surefoot::server
