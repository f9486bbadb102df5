#pragma once

// Errors that the library throws, and version and commit of the build.

#include "surefoot/base/build_info.hpp"
#include "surefoot/base/error.hpp"
