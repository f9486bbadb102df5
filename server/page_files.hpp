#pragma once

#include <span>
#include <string_view>

namespace surefoot::server {

/// A file of the viewer's page, embedded in the program.
struct PageFile {
  std::string_view name;        ///< "viewer.js"
  std::string_view media_type;  ///< "text/javascript; charset=utf-8"
  std::string_view data;
};

/// All files; "index.html" is the page. The build makes them from viewer/ (cmake/viewer.cmake).
[[nodiscard]] std::span<const PageFile> page_files();

}  // namespace surefoot::server
