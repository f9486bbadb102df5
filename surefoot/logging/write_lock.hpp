#pragma once

#include <string>

namespace surefoot {

/// Keeps a file, or all of a folder, to one writer while it lives. It goes away with the process,
/// however that ends, and leaves nothing behind that would have to be removed.
class WriteLock {
 public:
  /// Makes the file if there is none. Throws FileError, which calls it `shown` and names the
  /// process that has it, where another WriteLock does. Where nothing can be opened or locked there
  /// is no lock: whoever writes then says why that can't be.
  WriteLock(const std::string& path, const std::string& shown);
  ~WriteLock();
  WriteLock(const WriteLock&) = delete;
  WriteLock& operator=(const WriteLock&) = delete;

 private:
  int file_ = -1;
};

}  // namespace surefoot
