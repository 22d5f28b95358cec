// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/cli/chart_runs.hpp"

#include "core/base/text.hpp"
#include "core/results/result_fields.hpp"
#include "core/study/study_chart.hpp"
#include "tools/cli/commands.hpp"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <limits>
#include <spawn.h>
#include <stdexcept>
#include <sys/resource.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

extern char** environ;

namespace plyform {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

std::atomic<bool> interrupted{false};

void on_interrupt(int) {
  interrupted = true;
}

constexpr const char* cpu_key = "cpu_s ";

std::string content(const fs::path& file) {
  std::string reason;
  return read_text(file, reason).value_or("");
}

std::string settings_text(const StudyRun& run, int threads) {
  return run.inputs + fmt::format("threads {}\n", threads);
}

bool is_done(const StudyRun& run, const RunOptions& options) {
  const fs::path folder = options.folder / run.name;
  return content(folder / "settings.txt").starts_with(settings_text(run, options.threads)) &&
         ended(read_outcome(content(folder / "summary.json")).status) &&
         fs::is_regular_file(folder / "results.h5");
}

/// The last lines of a run's log.
std::string end_of_log(const fs::path& folder) {
  const std::string log = content(folder / "log.txt");
  const std::size_t most = 2000;
  return log.size() > most ? "... " + log.substr(log.size() - most) : log;
}

/// Progress display: number of finished runs and elapsed time. On a terminal one line that is
/// overwritten, elsewhere one line per finished run.
class ProgressBar {
public:
  ProgressBar(std::size_t done, std::size_t all) : done_(done), before_(done), all_(all) {}
  void tick() {
    if (!terminal_ || Clock::now() - drawn_ < std::chrono::milliseconds(200)) return;
    drawn_ = Clock::now();
    const std::size_t wide = 30, full = wide * done_ / std::max<std::size_t>(all_, 1);
    fmt::print(stderr, "\r[{}{}] {}/{} runs, {}  {}\033[K", std::string(full, '#'),
               std::string(wide - full, '-'), done_, all_, elapsed(), last_);
    std::fflush(stderr);
  }
  void finished(const std::string& what) {
    ++done_;
    last_ = what;
    if (!terminal_) fmt::print(stderr, "{}/{} runs, {}  {}\n", done_, all_, elapsed(), what);
  }
  void end() {
    drawn_ = {};
    tick();
    if (terminal_)
      fmt::print(stderr, "\n");
    else if (before_ == all_)
      fmt::print(stderr, "{0}/{0} runs were done before\n", all_);
  }

private:
  std::string elapsed() const {
    const long s = std::chrono::duration_cast<std::chrono::seconds>(Clock::now() - begin_).count();
    return fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60);
  }
  std::size_t done_, before_, all_;
  std::string last_;
  bool terminal_ = isatty(STDERR_FILENO) != 0;
  Clock::time_point begin_ = Clock::now(), drawn_{};
};

/// Starts a process `plyform run CASE ...` with its output in log.txt.
pid_t start_run(const StudyRun& run, const fs::path& case_file, const RunOptions& options) {
  const fs::path folder = options.folder / run.name;
  fs::create_directories(folder);
  fs::remove(folder / "settings.txt"); // results in this folder no longer count as done
  fs::remove(folder / "summary.json");
  std::vector<std::string> words{"plyform",
                                 "run",
                                 case_file.string(),
                                 "-o",
                                 folder.string(),
                                 "--threads",
                                 fmt::to_string(options.threads)};
  if (!run.accuracy.empty()) words.insert(words.end(), {"--accuracy", run.accuracy});
  for (const std::string& setting : run.settings)
    words.insert(words.end(), {"--set", setting});
  std::vector<char*> arguments;
  for (std::string& word : words)
    arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  const std::string log = (folder / "log.txt").string();
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC,
                                   0644);
  posix_spawn_file_actions_adddup2(&files, STDOUT_FILENO, STDERR_FILENO);
  pid_t process = 0;
  const int error =
      posix_spawn(&process, "/proc/self/exe", &files, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  if (error != 0)
    throw std::runtime_error(
        fmt::format("{}: the run cannot be started: {}", folder.string(), std::strerror(error)));
  return process;
}

struct Running {
  std::size_t run;
  pid_t process;
};

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

/// State of the runs of a study in progress.
struct StudyRuns {
  const StudyPlan& plan;
  const RunOptions& options;
  RunsEnd end;
  ProgressBar bar;
  std::vector<Running> running{};

  /// `exit`: of the process; -1 if a signal ended it.
  void finished(std::size_t index, int exit, double cpu_s) {
    const StudyRun& run = plan.runs[index];
    const fs::path folder = options.folder / run.name;
    if (exit == exit_done) {
      write_whole(folder / "settings.txt",
                  settings_text(run, options.threads) + fmt::format("{}{:.6g}\n", cpu_key, cpu_s));
      end.done[index] = true;
      bar.finished(fmt::format("{}: {:.1f} s", run.name,
                               read_outcome(content(folder / "summary.json")).wall_time_s));
    } else if (exit == exit_case_wrong) {
      end.code = exit_case_wrong;
      end.troubles.push_back(fmt::format("run {} was refused:\n{}", run.name, end_of_log(folder)));
    } else if (exit == exit_stopped) {
      bar.finished(run.name + ": stopped");
      end.troubles.push_back(
          fmt::format("run {} stopped: see {}", run.name, (folder / "log.txt").string()));
      if (index == 0) end.code = exit_stopped;
    } else if (!interrupted) {
      bar.finished(run.name + ": failed");
      end.troubles.push_back(fmt::format("run {} failed:\n{}", run.name, end_of_log(folder)));
      if (index == 0) end.code = exit_other;
    }
  }

  /// Collects the processes that have ended.
  void collect() {
    for (std::size_t i = 0; i < running.size();) {
      int status = 0;
      rusage usage{};
      const pid_t ended = wait4(running[i].process, &status, WNOHANG, &usage);
      if (ended == 0 || (ended < 0 && errno == EINTR)) {
        ++i;
        continue;
      }
      const Running one = running[i];
      running.erase(running.begin() + static_cast<long>(i));
      finished(one.run, ended > 0 && WIFEXITED(status) ? WEXITSTATUS(status) : -1,
               seconds(usage.ru_utime) + seconds(usage.ru_stime));
    }
  }

  void stop_running() {
    for (const Running& one : running)
      kill(one.process, SIGTERM);
    for (const Running& one : running)
      while (waitpid(one.process, nullptr, 0) < 0 && errno == EINTR) {
      }
    running.clear();
  }
};

} // namespace

RunsEnd run_all(const StudyPlan& plan, const fs::path& case_file, const RunOptions& options) {
  RunsEnd begin;
  // in the order of the plan: first the reference, which takes longest
  std::vector<std::size_t> waiting;
  for (std::size_t i = 0; i < plan.runs.size(); ++i) {
    begin.done.push_back(is_done(plan.runs[i], options));
    if (!begin.done.back()) waiting.push_back(i);
  }
  StudyRuns runs{plan, options, begin, {plan.runs.size() - waiting.size(), plan.runs.size()}};
  std::signal(SIGCHLD, SIG_DFL); // if inherited as ignored, exit codes would be lost
  std::signal(SIGINT, on_interrupt);
  std::signal(SIGTERM, on_interrupt);
  try {
    for (std::size_t next = 0; !interrupted && runs.end.code == 0;) {
      while (next < waiting.size() && runs.running.size() < static_cast<std::size_t>(options.jobs))
        runs.running.push_back(
            {waiting[next], start_run(plan.runs[waiting[next]], case_file, options)}),
            ++next;
      if (runs.running.empty()) break;
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      runs.collect();
      runs.bar.tick();
    }
  } catch (...) {
    runs.stop_running();
    throw;
  }
  runs.stop_running();
  runs.bar.end();
  if (interrupted) {
    runs.end.code = exit_other;
    runs.end.troubles.push_back("interrupted; finished runs are kept, the same command goes on");
  }
  return std::move(runs.end);
}

double cpu_time(const fs::path& run_folder) {
  const std::string text = content(run_folder / "settings.txt");
  const std::size_t from = text.rfind(cpu_key);
  return from == std::string::npos
             ? std::numeric_limits<double>::quiet_NaN()
             : std::strtod(text.c_str() + from + std::strlen(cpu_key), nullptr);
}

} // namespace plyform
