#pragma once

namespace surefoot {

/// Makes the calling thread yield to the control loop: a niceness 5 above that of its process, and
/// SCHED_BATCH, which preempts no other thread when it wakes. `top -H` shows `name` (at most 15
/// letters).
void become_background(const char* name);

}  // namespace surefoot
