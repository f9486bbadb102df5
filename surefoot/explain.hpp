#pragma once

// What gave way to what, at what cost: of a tick of a log, and of a solved hierarchy.

#include "surefoot/explain/explain.hpp"
