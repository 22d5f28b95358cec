// SPDX-License-Identifier: GPL-3.0-or-later
// Uses of the installed core library: a case read, checked and run for one step, its results
// written. consumer RESULT_FOLDER
#include "core/results/result_writer.hpp"
#include "core/run/run.hpp"
#include "core/setup/prepare_case.hpp"

#include <cstdio>

int main(int argc, char** argv) {
  using namespace plyform;
  if (argc != 2) return 2;
  const auto reading = prepare_case(CASES "/hemisphere_five_ply/case.toml", {});
  for (const auto& error : reading.errors)
    std::printf("%s\n", error.text().c_str());
  if (!reading.value || reading.value->plies.size() != 5) return 1;

  ResultWriter writer(argv[1]);
  const std::atomic<bool> interrupt = true;
  const RunResult result = run_case(
      *reading.value, 1,
      {[&](const Frame& frame) { writer.write_frame(frame); }, [](const Progress&) {}, &interrupt});
  writer.write_final(result.last, result.summary);
  std::printf("%zu plies, %s\n", result.last.plies.size(), result.summary.status.c_str());
  return result.summary.status == "interrupted" && result.last.plies.size() == 5 ? 0 : 1;
}
