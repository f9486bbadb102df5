#pragma once

#include "tests/support/messages.hpp"
