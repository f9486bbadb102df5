#pragma once

#include <string>

namespace surefoot::logging {

/// Reserves a file, or a whole folder, for one writer during its lifetime. Ends with the process in
/// any case, and leaves nothing to clean up.
class WriteLock {
 public:
  /// Creates a missing file. Throws FileError, with the name `shown` and the other process, if
  /// another WriteLock holds it. If the file can't be opened or locked there is no lock: writing
  /// will fail and say why.
  WriteLock(const std::string& path, const std::string& shown);
  ~WriteLock();
  WriteLock(const WriteLock&) = delete;
  WriteLock& operator=(const WriteLock&) = delete;

 private:
  int file_ = -1;
};

}  // namespace surefoot::logging
