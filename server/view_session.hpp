#pragma once

#include "server/view_channels.hpp"
#include "surefoot/base/scale.hpp"
#include "surefoot/model/mesh_files.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace surefoot::server {

/// Limits of commands of the page.
struct ViewLimits {
  double push_impulse = 60.0;  ///< [N·s]
  double push_force = 300.0;   ///< of all pushes at one time [N]
  double push_duration = 1.0;  ///< [s]
  double slowest = 0.03125;    ///< of real time
  double fastest = 8.0;
  double walk_velocity = 0.5;  ///< [m/s]
  double walk_yaw_rate = 0.6;  ///< [rad/s]
  double walk_height = 0.1;    ///< offset, up or down [m]
  double friction_min = 0.05, friction_max = 2.0;
};

/// Those of a robot of this size, in two digits; with gaits as fast as `speed` [m/s].
[[nodiscard]] ViewLimits limits_for(const Scale& scale, double speed = 0.0);

/// A number of a task that can be changed.
struct ViewNumber {
  std::string name, unit, about;
  double value = 0.0;
  double min = 0.0, max = 0.0;  ///< valid range
};

/// A task of a level, with its numbers.
struct ViewTask {
  std::size_t level = 0;  ///< in `header.level_names`
  std::string level_name, task;
  std::vector<ViewNumber> numbers;
};

/// The levels in their order from a tick on.
struct ViewOrder {
  std::uint32_t tick = 0;
  std::vector<std::string> levels;
};

/// What of a session may change when a run begins again.
struct ViewRun {
  std::string header;  ///< the log's header, JSON
  ViewChannels channels;
  std::vector<std::vector<std::string>> rows;  ///< of each level of the header
  std::vector<ViewOrder> orders;
  std::vector<ViewTask> tasks;
  std::vector<std::string> bodies;  ///< that can be pushed
  double friction = 0.0;            ///< that the controller assumes
};

/// What a page needs before the frames of a run: /api/session of viewer/README.md.
struct ViewSession : ViewRun {
  std::string start;  ///< names this start of the program: another serves another run
  std::string mode;   ///< "live" or "replay"
  std::string version, title, source;
  std::string cut;         ///< of a log: why the run does not end where it should; "": it does
  std::string ended;       ///< of a log: why its run ended; "": that is not known
  double period = 0.0025;  ///< of the ticks [s]
  std::uint32_t first_tick = 0, ticks = 0;
  std::uint32_t summarised = 0;     ///< of a log: ticks that are summarised
  std::vector<std::string> damage;  ///< of a log: sentences on what can't be read, so far
  std::vector<model::MeshFile> meshes;
  ViewLimits limits;
  std::vector<std::string> gaits;  ///< that the user may change to
  std::uint32_t generation = 0;
  std::uint32_t begun = 0;  ///< generation with which the present run began
};

[[nodiscard]] std::string to_json(const ViewSession& session);

}  // namespace surefoot::server
