#pragma once

#include <string>
#include <vector>

namespace surefoot::server {

/// This machine's addresses as in a link: those of the network, then loopback, then "localhost".
/// IPv6 addresses are in brackets.
[[nodiscard]] std::vector<std::string> own_hosts(bool with_ipv6);

/// Whether ::1 is an address of this machine.
[[nodiscard]] bool has_ipv6_loopback();

}  // namespace surefoot::server
