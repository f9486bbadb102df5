#pragma once

#include <string>

namespace surefoot::logging {

/// Writes what can be read of an MCAP file as a whole one: attachments, metadata and all messages
/// in their order. Returns what is lost, as `McapReader::problem`. Throws FileError as McapReader
/// and McapWriter do; then no file is left.
std::string mend_log(const std::string& from, const std::string& to);

}  // namespace surefoot::logging
