// SPDX-License-Identifier: GPL-3.0-or-later
// make_results DIR: writes the results of a made-up run of three times, and their export, for
// tests/python/results_vtk_test.py to open; and in DIR/single those of a run with one ply and no
// tool.
#include "core/results/export.hpp"
#include "core/run/ply_plausibility.hpp"
#include "support/example_results.hpp"

#include <cstdio>
#include <exception>

/// With what a run says of each ply.
static plyform::Summary summary_of(const plyform::Frame& frame) {
  plyform::Summary summary;
  for (const plyform::PlyFrame& ply : frame.plies)
    summary.plies.push_back(plyform::report_ply(ply, {.locking_angle_deg = 2.0}, {}));
  return summary;
}

int main(int argc, char** argv) try {
  if (argc != 2) {
    std::fputs("usage: make_results DIR\n", stderr);
    return 2;
  }
  using namespace plyform;
  ResultWriter writer(argv[1]);
  for (const double time : {0.0, 0.5, 1.0})
    writer.write_frame(example::frame(time));
  writer.write_final(example::frame(1.0), summary_of(example::frame(1.0)));
  export_results(argv[1]);
  Frame single = example::frame(1.0); // one ply, no tools: still a named block?
  single.plies.resize(1);
  single.tools.clear();
  ResultWriter(std::filesystem::path(argv[1]) / "single").write_final(single, summary_of(single));
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "make_results: %s\n", error.what());
  return 1;
}
