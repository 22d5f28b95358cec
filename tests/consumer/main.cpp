// SPDX-License-Identifier: GPL-3.0-or-later
// Uses of the installed core library that need toml++ (read_case) and HDF5 (ResultWriter):
//   consumer RESULT_FOLDER
#include "core/results/result_writer.hpp"
#include "core/setup/prepare_case.hpp"

#include <cstdio>

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const auto reading = plyform::prepare_case(CASES "/hemisphere_five_ply/case.toml", {});
  for (const auto& error : reading.errors)
    std::printf("%s\n", error.text().c_str());
  if (!reading.value || reading.value->plies.size() != 5) return 1;

  const plyform::ResultWriter writer(argv[1]);
  std::printf("%zu plies\n", reading.value->plies.size());
  return 0;
}
