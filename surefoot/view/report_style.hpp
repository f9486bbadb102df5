#pragma once

#include <string>

/// How the report looks.
namespace surefoot::report {

/// CSS of the page and of the images in it, in light and dark.
[[nodiscard]] std::string page_style();

/// CSS of an image that stands alone: light, and without variables, which browsers alone know.
[[nodiscard]] std::string image_style();

}  // namespace surefoot::report
