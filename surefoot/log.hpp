#pragma once

// Logs of runs: write, read, compute again and compare.

#include "surefoot/logging/log_reader.hpp"
#include "surefoot/logging/recorder.hpp"
#include "surefoot/replay/log_replay.hpp"
#include "surefoot/replay/log_verification.hpp"
#include "surefoot/replay/stack_comparison.hpp"
