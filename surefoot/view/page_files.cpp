#include "surefoot/view/page_files.hpp"

#include <array>

namespace surefoot {

std::span<const PageFile> page_files() {
  static constexpr std::array<PageFile, 1> kFiles{
      {{"index.html", "text/html; charset=utf-8",
        "<!doctype html><html lang=\"en\"><title>surefoot</title><p>The viewer's page was not "
        "bundled into this program: build viewer/ first.</p></html>\n"}}};
  return kFiles;
}

}  // namespace surefoot
