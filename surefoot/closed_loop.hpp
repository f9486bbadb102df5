#pragma once

// A scenario's whole run: plant against controller, judged and logged.

#include "surefoot/closed_loop/closed_loop.hpp"
