#pragma once

namespace surefoot {

/// Of the calling thread, which does what can wait: gives it a name of at most 15 letters, as
/// `top -H` shows it, and less of a busy processor, so that the control loop comes first: a
/// niceness 5 above that of its process, and the scheduling policy SCHED_BATCH, by which it takes
/// the processor from no other thread when it wakes.
void become_background(const char* name);

}  // namespace surefoot
