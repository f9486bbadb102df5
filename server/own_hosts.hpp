#pragma once

#include <string>
#include <vector>

namespace surefoot::server {

/// This machine's addresses as they stand in a link, those of the network before loopback, and
/// "localhost" last; with IPv6 in brackets if it is wanted.
[[nodiscard]] std::vector<std::string> own_hosts(bool with_ipv6);

/// Whether ::1 is an address of this machine.
[[nodiscard]] bool has_ipv6_loopback();

}  // namespace surefoot::server
