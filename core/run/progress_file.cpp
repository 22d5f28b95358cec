// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/run/progress_file.hpp"

#include "base/write_whole.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <system_error>
#include <unistd.h>

namespace plyform {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr double between = 0.5; // s, of writing

const char* word(RunPhase phase) {
  switch (phase) {
  case RunPhase::checking:
    return "checking";
  case RunPhase::meshing:
    return "meshing";
  case RunPhase::forming:
    return "forming";
  case RunPhase::verifying:
    return "verifying";
  case RunPhase::correcting:
    return "correcting";
  }
  return "";
}

/// The file itself, where its folder was given.
fs::path whole_path(const fs::path& file) {
  std::error_code ignored;
  const fs::path path = fs::is_directory(file, ignored) ? file / "case.toml" : file;
  const fs::path absolute = fs::absolute(path, ignored);
  return ignored ? path : absolute.lexically_normal();
}

} // namespace

ProgressFile::ProgressFile(const fs::path& folder, const fs::path& case_file)
    : path_(folder / progress_file_name), case_file_(whole_path(case_file)) {}

ProgressFile::~ProgressFile() {
  std::error_code ignored;
  fs::remove(path_, ignored);
}

void ProgressFile::begin(RunPhase phase, const std::string& words) {
  if (phase != phase_) {
    begin_ = Clock::now();
    progress_.reset();
    left_ = {};
  }
  phase_ = phase;
  words_ = words;
  write();
}

void ProgressFile::show(const Progress& progress, double fraction, std::size_t states) {
  progress_ = progress;
  fraction_ = fraction;
  left_.show(std::chrono::duration<double>(Clock::now() - begin_).count(), fraction);
  states_ = states;
  if (std::chrono::duration<double>(Clock::now() - written_).count() >= between) write();
}

void ProgressFile::write() {
  written_ = Clock::now();
  const double passed = std::chrono::duration<double>(written_ - begin_).count();
  const bool known = progress_.has_value();
  const auto or_null = [](bool given, auto value) { return given ? Json(value) : Json(); };
  const Progress now = progress_.value_or(Progress{});
  // The run knows of what it did before it went on; a phase of several runs is timed here.
  const bool one_run = known && phase_ == RunPhase::forming;
  const double remaining = one_run ? now.remaining_s : left_.left(passed).value_or(0.0);
  const bool foreseen = known && (remaining > 0.0 || fraction_ >= 1.0);
  const auto rounded = [](double seconds) { return std::round(10.0 * seconds) / 10.0; };
  Json all;
  all["phase"] = word(phase_);
  all["words"] = words_;
  all["fraction"] = or_null(known, fraction_);
  all["stroke_mm"] = or_null(known, now.stroke_mm);
  all["step"] = or_null(known, now.step);
  all["elapsed_s"] = rounded(one_run ? now.elapsed_s : passed);
  all["remaining_s"] = or_null(foreseen, rounded(remaining));
  all["kinetic_over_shear"] = or_null(known, now.kinetic_over_shear);
  all["balance_error"] = or_null(known, now.balance_error);
  all["states"] = states_;
  all["pid"] = getpid();
  all["case"] = case_file_.string();
  write_if_possible(path_, all.dump(2, ' ', false, Json::error_handler_t::replace) + '\n');
}

} // namespace plyform
