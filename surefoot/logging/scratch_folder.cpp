#include "surefoot/logging/scratch_folder.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/logging/output_files.hpp"

#include <stdlib.h>

#include <system_error>

namespace surefoot::logging {

namespace fs = std::filesystem;

ScratchFolder::ScratchFolder() {
  std::string name = (fs::temp_directory_path() / "surefoot_XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) {
    throw FileError(name + ": no folder for temporary files can be made there");
  }
  path_ = name;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

std::string ScratchFolder::write(const std::string& name, const std::string& text) const {
  write_file(path_ / name, text);
  return (path_ / name).string();
}

}  // namespace surefoot::logging
