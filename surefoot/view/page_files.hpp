#pragma once

#include <span>
#include <string_view>

namespace surefoot {

/// A file of the viewer's page, embedded in the program.
struct PageFile {
  std::string_view name, media_type, data;
};

/// All of them; "index.html" is the page itself.
[[nodiscard]] std::span<const PageFile> page_files();

}  // namespace surefoot
