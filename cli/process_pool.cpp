#include "cli/process_pool.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/runtime/interrupt.hpp"

#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>

namespace surefoot {
namespace {

constexpr int kThrew = 1;
constexpr int kPollMilliseconds = 200;  // also how soon an interrupt is seen

struct Child {
  std::size_t job = 0;
  pid_t pid = 0;
  int pipe = 0;
  std::string output;
};

void write_all(int file, const std::string& text) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t written = write(file, text.data() + done, text.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return;
    done += static_cast<std::size_t>(written);
  }
}

[[noreturn]] void work(const Job& job, int pipe) {
  int status = 0;
  std::string text;
  try {
    text = job();
  } catch (const std::exception& error) {
    text = error.what();
    status = kThrew;
  }
  write_all(pipe, text);
  // Not exit(): buffers and objects of the parent are not ours.
  _exit(status);
}

Child start(std::size_t number, const Job& job) {
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0)
    throw Error(std::string("no pipe to a new process: ") + std::strerror(errno));
  std::fflush(nullptr);
  const pid_t pid = fork();
  if (pid < 0) throw Error(std::string("no new process: ") + std::strerror(errno));
  if (pid == 0) {
    close(ends[0]);
    work(job, ends[1]);
  }
  close(ends[1]);
  return {.job = number, .pid = pid, .pipe = ends[0], .output = {}};
}

/// False at the end of what the child writes.
bool read_some(Child& child) {
  std::array<char, 65536> buffer{};
  const ssize_t count = read(child.pipe, buffer.data(), buffer.size());
  if (count < 0 && errno == EINTR) return true;
  if (count <= 0) return false;
  child.output.append(buffer.data(), static_cast<std::size_t>(count));
  return true;
}

JobOutcome collect(Child& child) {
  close(child.pipe);
  int status = 0;
  while (waitpid(child.pid, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFSIGNALED(status)) {
    return {.output = {},
            .failure = std::string("the process was ended by: ") + strsignal(WTERMSIG(status))};
  }
  if (WEXITSTATUS(status) != 0) return {.output = {}, .failure = child.output};
  return {.output = std::move(child.output), .failure = {}};
}

/// Waits until some children wrote something; moves those that ended out of `running`.
std::vector<Child> wait_for_some(std::vector<Child>& running) {
  std::vector<pollfd> waiting;
  for (const Child& child : running)
    waiting.push_back({.fd = child.pipe, .events = POLLIN, .revents = 0});
  std::vector<Child> ended;
  if (poll(waiting.data(), waiting.size(), kPollMilliseconds) <= 0) return ended;
  for (std::size_t i = running.size(); i-- > 0;) {
    if (waiting[i].revents == 0 || read_some(running[i])) continue;
    ended.push_back(std::move(running[i]));
    running.erase(running.begin() + static_cast<std::ptrdiff_t>(i));
  }
  return ended;
}

}  // namespace

void run_in_processes(const std::vector<Job>& jobs, int at_once,
                      const std::function<void(std::size_t job, const JobOutcome&)>& finished) {
  std::vector<Child> running;
  bool told_to_end = false;
  for (std::size_t next = 0; next < jobs.size() || !running.empty();) {
    while (!interrupted() && next < jobs.size() &&
           running.size() < static_cast<std::size_t>(at_once)) {
      running.push_back(start(next, jobs[next]));
      ++next;
    }
    if (interrupted() && !told_to_end) {
      next = jobs.size();
      std::ranges::for_each(running, [](const Child& child) { kill(child.pid, SIGTERM); });
      told_to_end = true;
    }
    for (Child& child : wait_for_some(running)) finished(child.job, collect(child));
  }
}

}  // namespace surefoot
