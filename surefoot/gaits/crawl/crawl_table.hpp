#pragma once

#include <array>
#include <string_view>

namespace surefoot::gaits {

/// States of the crawl.
enum class CrawlState {
  stand,   ///< another gait is active
  shift,   ///< all feet stand, the COM moves until the next leg can lift off
  unload,  ///< the force limit of the next leg ramps down
  swing,   ///< the next leg is in the air
};

/// Causes of the crawl's transitions.
enum class CrawlCause {
  walks,
  stops,
  another_goes_first,
  goes_on,
  unloads,
  reloads,
  lifts_off,
  goes_on_swinging,
  lands,
  steps_to_recover,
};

struct CrawlTransition {
  CrawlState from;
  CrawlCause cause;
  CrawlState to;
  std::string_view why;
};

/// All transitions: the crawl changes its state by this table only.
inline constexpr std::array kCrawlTable{
    CrawlTransition{CrawlState::stand, CrawlCause::walks, CrawlState::shift,
                    "commanded to walk, all feet down"},
    CrawlTransition{CrawlState::stand, CrawlCause::steps_to_recover, CrawlState::swing,
                    "pushed out of balance, steps to recover"},
    CrawlTransition{CrawlState::shift, CrawlCause::stops, CrawlState::stand,
                    "no longer commanded to walk"},
    CrawlTransition{CrawlState::shift, CrawlCause::another_goes_first, CrawlState::shift,
                    "support too thin for the next swing, another leg first"},
    CrawlTransition{CrawlState::shift, CrawlCause::goes_on, CrawlState::shift,
                    "at rest again after a push or slip"},
    CrawlTransition{CrawlState::shift, CrawlCause::unloads, CrawlState::unload,
                    "lift-off is near, all feet down"},
    CrawlTransition{CrawlState::shift, CrawlCause::steps_to_recover, CrawlState::swing,
                    "pushed out of balance, steps to recover"},
    CrawlTransition{CrawlState::unload, CrawlCause::reloads, CrawlState::shift,
                    "lift-off aborted, or a push, a slip or a lost foot"},
    CrawlTransition{CrawlState::unload, CrawlCause::lifts_off, CrawlState::swing,
                    "leg unloaded, balanced without it"},
    CrawlTransition{CrawlState::unload, CrawlCause::steps_to_recover, CrawlState::swing,
                    "pushed out of balance, steps to recover"},
    CrawlTransition{CrawlState::swing, CrawlCause::goes_on_swinging, CrawlState::swing,
                    "probe, collision, caught, no ground, foot down at once"},
    CrawlTransition{CrawlState::swing, CrawlCause::lands, CrawlState::shift, "touchdown"},
};

[[nodiscard]] constexpr std::string_view name(CrawlState state) {
  constexpr std::array<std::string_view, 4> kNames{"stand", "shift", "unload", "swing"};
  return kNames[static_cast<std::size_t>(state)];
}

/// Null if the table has no such transition.
[[nodiscard]] constexpr const CrawlTransition* find_transition(CrawlState from, CrawlCause cause) {
  for (const CrawlTransition& row : kCrawlTable) {
    if (row.from == from && row.cause == cause) return &row;
  }
  return nullptr;
}

}  // namespace surefoot::gaits
