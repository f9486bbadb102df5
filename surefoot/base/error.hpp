#pragma once

#include <stdexcept>
#include <string>

namespace surefoot {

/// The caller's input is wrong, at set-up. The message says what was given and what would be valid.
/// Never thrown from the control loop.
class Error : public std::runtime_error {
 public:
  explicit Error(const std::string& message) : std::runtime_error(message) {}
};

/// A file can't be read, written or understood; the message starts with `file:line:` where known.
class FileError : public Error {
 public:
  using Error::Error;
};

/// A name or value is not one of those that exist.
class UnknownNameError : public Error {
 public:
  using Error::Error;
};

}  // namespace surefoot
