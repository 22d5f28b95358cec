// SPDX-License-Identifier: GPL-3.0-or-later
// tests/python/results_vtk_test.py opens the same files with h5py and ParaView's readers.
#include "core/results/export.hpp"
#include "tests/support/results_helpers.hpp"

#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fcntl.h>
#include <functional>
#include <gtest/gtest.h>
#include <limits>
#include <map>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace plyform::result_writer_test {
namespace {

using namespace results_test;
using Results = ResultFolder;
constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();

/// Runs `action` in a process of its own, so that limits and signals stay there; its exit status.
template <class Action>
int in_child(Action action) {
  const pid_t child = fork();
  if (child == 0) {
    action();
    _exit(0);
  }
  int status = -1;
  waitpid(child, &status, 0);
  return status;
}

TEST(Energies, BalanceErrorIsTheSumOverTheLargestTerm) {
  EXPECT_EQ(Energies{}.balance_error(), 0);
  // 1+2+3+8+7+4+5+6+9-44 = 1 over 44
  EXPECT_DOUBLE_EQ((Energies{1, 2, 3, 8, 7, 4, 5, 6, 9, 44}.balance_error()), 1.0 / 44.0);
  EXPECT_DOUBLE_EQ((Energies{0, 0, 0, 0, 0, 0, 0, 0, 0, -4}.balance_error()), 1);
  EXPECT_TRUE(std::isnan(Energies{1, nan_value, 1, 1, 1, 1, 1, 1, 1, 1}.balance_error()));
}

TEST_F(Results, AFinishedRunLeavesTheseFilesAndNoOthers) {
  write_run(directory, {0.0, 0.5});
  EXPECT_EQ(
      files_in(directory),
      (std::vector<std::string>{"history.csv", "plies/90\u00b0 ply & co.csv", "plies/lower.csv",
                                "results.h5", "results.xdmf", "summary.json"}));
}

TEST_F(Results, HistoryHasOneRowAnOutputTime) {
  write_run(directory, {0.0, 0.5, 1.0});
  const auto rows = rows_of(content(directory / "history.csv"));
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(rows[0], (std::vector<std::string>{"time_s",
                                               "stroke_mm",
                                               "punch_force_N",
                                               "punch_force_raw_N",
                                               "punch_displacement_mm",
                                               "die_force_N",
                                               "die_force_raw_N",
                                               "die_displacement_mm",
                                               "grip_force_N",
                                               "grip_displacement_mm",
                                               "clamp_force_N",
                                               "clamp_displacement_mm",
                                               "kinetic_mJ",
                                               "fibre_mJ",
                                               "shear_mJ",
                                               "bending_mJ",
                                               "contact_mJ",
                                               "friction_mJ",
                                               "damping_mJ",
                                               "external_mJ",
                                               "mass_scaling_mJ",
                                               "balance_error"}));
  EXPECT_EQ(rows[2], (std::vector<std::string>{
                         "0.5", "25",  "200", "210", "25", "-15", "-14", "0", "35", "4", "-4.5",
                         "0",   "0.5", "1",   "1.5", "0",  "2",   "2.5", "3", "10", "0", "0.05"}));
}

TEST_F(Results, PlyTableHasOneRowATriangleInTheNamedColumns) {
  write_run(directory, {0.7});
  const PlyFrame ply = frame(0.7).plies[0];
  const auto rows = rows_of(content(directory / "plies/lower.csv"));
  ASSERT_EQ(rows.size(), 1 + ply.triangles.size());
  std::map<std::string, std::size_t> column;
  for (std::size_t k = 0; k < rows[0].size(); ++k)
    column[rows[0][k]] = k;
  EXPECT_EQ(column.size(), 18u);
  for (std::size_t i = 0; i < ply.triangles.size(); ++i) {
    const auto is = [&](const std::string& name, double wanted) {
      ASSERT_TRUE(column.count(name)) << name;
      const double found = std::stod(rows[i + 1].at(column[name]));
      // nine digits: half a unit of the ninth; 1e-12 mm for a sum that is 0 but for rounding
      EXPECT_NEAR(found, wanted, 6e-9 * std::abs(wanted) + 1e-12) << name << " of triangle " << i;
    };
    Vec3 before = Vec3::Zero(), now = Vec3::Zero();
    for (const int node : ply.triangles[i]) {
      before += ply.x0[node] / 3;
      now += ply.x[node] / 3;
    }
    for (int k = 0; k < 3; ++k) {
      const std::string axis(1, "xyz"[k]);
      is(axis + "0", before[k]);
      is(axis, now[k]);
      is("warp_" + axis, ply.families[0].direction[i][k]);
      is("weft_" + axis, ply.families[1].direction[i][k]);
    }
    is("shear_angle_deg", ply.shear_deg[i]);
    is("warp_strain", ply.families[0].strain[i]);
    is("weft_strain", ply.families[1].strain[i]);
    is("warp_tension_N", ply.families[0].tension[i]);
    is("weft_tension_N", ply.families[1].tension[i]);
    is("thickness_mm", ply.thickness[i]);
  }
}

TEST_F(Results, LastStateComesBackBitForBit) {
  write_run(directory, {0.0, 0.3, 1.0 / 3.0});
  expect_same(read_last_frame(directory / "results.h5"), frame(1.0 / 3.0));
}

TEST_F(Results, AStateThatIsNoOutputTimeBecomesTheLastFrame) {
  ResultWriter writer(directory);
  writer.write_frame(frame(0.5));
  writer.write_final(frame(0.6), Summary{});
  expect_same(read_last_frame(directory / "results.h5"), frame(0.6));
  EXPECT_EQ(rows_of(content(directory / "history.csv")).size(), 3u);
}

TEST_F(Results, AKilledRunLeavesAFileThatOpens) {
  const int status = in_child([&] {
    ResultWriter writer(directory);
    writer.write_frame(frame(0.0));
    writer.write_frame(frame(0.5));
    raise(SIGKILL);
  });
  ASSERT_TRUE(WIFSIGNALED(status));
  expect_same(read_last_frame(directory / "results.h5"), frame(0.5));
  EXPECT_EQ(rows_of(content(directory / "history.csv")).size(), 3u);
  EXPECT_TRUE(contains(content(directory / "results.xdmf"), "Value=\"0.5\""));
  EXPECT_TRUE(contains(content(directory / "results.xdmf"), "</Xdmf>"));
}

TEST_F(Results, ARunCanBeLookedAtWhileItGoesOn) {
  ResultWriter writer(directory);
  for (const double time : {0.25, 0.5}) {
    writer.write_frame(frame(time));
    const int file = open((directory / "results.h5").c_str(), O_RDONLY);
    EXPECT_EQ(flock(file, LOCK_SH | LOCK_NB), 0) << "HDF5 readers would refuse a locked file";
    close(file);
    // a copy, as HDF5 would share what is open within one process
    fs::copy_file(directory / "results.h5", directory / "seen.h5",
                  fs::copy_options::overwrite_existing);
    expect_same(read_last_frame(directory / "seen.h5"), frame(time));
  }
}

TEST_F(Results, ASecondRunReplacesTheFilesOfTheFirst) {
  write_run(directory, {0.0, 0.5});
  put(directory / "plies/notes.txt", "mine");
  put(directory / "photo.csv", "mine");
  put(directory / "plies/gone.csv", "x0,y0,z0,x,y,z\n"); // of a former run
  Frame other = frame(0.25);
  other.plies.pop_back();
  ResultWriter writer(directory);
  EXPECT_TRUE(fs::exists(directory / "summary.json")) << "kept until the new run has a state";
  writer.write_frame(other);
  EXPECT_EQ(files_in(directory),
            (std::vector<std::string>{"history.csv", "photo.csv", "plies/notes.txt", "results.h5",
                                      "results.xdmf", "states/000000.h5", "states/meshes.h5"}));
  writer.write_final(other, Summary{});
  EXPECT_EQ(files_in(directory / "plies"), (std::vector<std::string>{"lower.csv", "notes.txt"}));
  EXPECT_EQ(read_last_frame(directory / "results.h5").plies.size(), 1u);
  EXPECT_EQ(rows_of(content(directory / "history.csv")).size(), 2u);
}

TEST_F(Results, AnyNumberOfPliesToolsAndBoundariesWillDo) {
  for (const std::size_t plies : {0u, 1u, 2u})
    for (const std::size_t others : {0u, 1u}) {
      Frame some = frame(0.5);
      some.plies.resize(plies);
      some.tools.resize(others);
      some.boundaries.resize(others);
      ResultWriter writer(directory);
      writer.write_final(some, Summary{});
      expect_same(read_last_frame(directory / "results.h5"), some);
    }
}

// Errors.

TEST_F(Results, AFolderThatCannotBeMadeIsNamedWithTheReason) {
  fs::create_directories(directory);
  put(directory / "file", "");
  const std::string error = error_of([&] { ResultWriter writer(directory / "file/deeper"); });
  EXPECT_TRUE(contains(error, (directory / "file/deeper").string())) << error;
  EXPECT_TRUE(contains(error, "Not a directory")) << error;
}

/// Full and failing disks: tests/cli/full_disk_test.sh.
TEST_F(Results, NoLinkThatStandsInTheWayIsWrittenThrough) {
  const std::map<std::string, std::string> files = {
      {"history.csv", "."}, {"results.xdmf", "."}, {"summary.json", "."}, {"lower.csv", "plies"}};
  for (const auto& [name, folder] : files) {
    const fs::path target = directory / folder / name, other = directory / "other.txt";
    ResultWriter writer(directory);
    put(other, "of somebody else");
    fs::remove(target.string() + ".tmp");
    writer.write_frame(frame(0.5));
    fs::create_symlink(other, target.string() + ".tmp");
    writer.write_frame(frame(0.6));
    writer.write_final(frame(0.6), Summary{});
    EXPECT_EQ(content(other), "of somebody else") << name;
    EXPECT_TRUE(fs::is_regular_file(fs::symlink_status(target))) << name;
    EXPECT_GT(fs::file_size(target), 0u) << name;
    EXPECT_FALSE(fs::is_symlink(target.string() + ".tmp")) << "the temporary file stays behind";
  }
}

/// Writes two frames in a child, then what `more` does to the writer, while files may not grow
/// beyond `limit` bytes, which stands for a full disk. Expects that the child ends in order all the
/// same, and returns what it said.
std::string error_of_full_disk(const fs::path& directory, rlim_t limit,
                               const std::function<void(ResultWriter&)>& more) {
  const fs::path message = directory.string() + ".txt";
  const int status = in_child([&] {
    signal(SIGXFSZ, SIG_IGN);
    const std::string error = error_of([&] {
      ResultWriter writer(directory);
      writer.write_frame(frame(0.25));
      writer.write_frame(frame(0.5));
      const rlimit size{limit, RLIM_INFINITY};
      if (setrlimit(RLIMIT_FSIZE, &size) != 0) _exit(9);
      more(writer);
    });
    const rlimit none{RLIM_INFINITY, RLIM_INFINITY};
    setrlimit(RLIMIT_FSIZE, &none);
    put(message, error);
  });
  EXPECT_EQ(status, 0) << "limit " << limit;
  const std::string error = content(message);
  fs::remove(message);
  return error;
}

/// Bytes of a file of a run of two frames, without a limit.
rlim_t size_in_whole_run(const fs::path& directory, const char* file, bool ended) {
  ResultWriter writer(directory);
  writer.write_frame(frame(0.25));
  writer.write_frame(frame(0.5));
  if (ended) writer.write_final(frame(0.5), Summary{});
  const rlim_t size = fs::file_size(directory / file);
  fs::remove_all(directory);
  return size;
}

TEST_F(Results, AFullDiskIsNoticedInTheStatesAndTheFormerOnesStay) {
  const rlim_t size = size_in_whole_run(directory, "states/000001.h5", false);
  for (rlim_t limit = 100; limit < size; limit += (size - 101) / 8) {
    const std::string error = error_of_full_disk(
        directory, limit, [](ResultWriter& writer) { writer.write_frame(frame(0.75)); });
    EXPECT_TRUE(contains(error, (directory / "states/000002.h5").string())) << limit << error;
    EXPECT_TRUE(contains(error, "File too large")) << limit << ": " << error;
    expect_same(read_last_frame(directory / "results.h5"), frame(0.5));
    EXPECT_EQ(rows_of(content(directory / "history.csv")).size(), 3u);
    EXPECT_FALSE(fs::exists(directory / "states/000002.h5.tmp")) << "the temporary file stays";
    fs::remove_all(directory);
  }
}

TEST_F(Results, ADiskThatIsFullInTheEndLeavesTheStatesToRead) {
  const rlim_t size = size_in_whole_run(directory, "results.h5", true);
  const std::string error = error_of_full_disk(
      directory, size - 1, [](ResultWriter& writer) { writer.write_final(frame(0.5), Summary{}); });
  EXPECT_TRUE(contains(error, (directory / "results.h5").string())) << error;
  EXPECT_TRUE(contains(error, "File too large")) << error;
  expect_same(read_last_frame(directory / "results.h5"), frame(0.5));
}

TEST_F(Results, NamesThatCannotBeFilesOrStandTwiceAreRefused) {
  for (const char* name : {"", "..", ".hidden", "a/b", "a\\b", "a\nb", "a\"b", "a:b"}) {
    Frame bad = frame(0.5);
    bad.plies[1].name = name;
    const std::string error = error_of([&] { ResultWriter(directory).write_frame(bad); });
    EXPECT_TRUE(contains(error, "cannot be a file name")) << '"' << name << "\": " << error;
  }
  Frame twice = frame(0.5);
  twice.tools[0].name = "lower";
  const std::string error = error_of([&] { ResultWriter(directory).write_frame(twice); });
  EXPECT_TRUE(contains(error, "\"lower\" is used twice")) << error;
  Frame as_tool = frame(0.5); // both would head the same columns of history.csv
  as_tool.boundaries[1].name = "punch";
  const std::string error_too = error_of([&] { ResultWriter(directory).write_frame(as_tool); });
  EXPECT_TRUE(contains(error_too, "\"punch\" is used twice")) << error_too;
  EXPECT_EQ(files_in(directory), std::vector<std::string>{});
}

TEST_F(Results, ArraysOfAWrongSizeAreRefused) {
  Frame bad = frame(0.5);
  bad.plies[0].thickness.pop_back();
  EXPECT_THROW(ResultWriter(directory).write_frame(bad), std::logic_error);
  Frame other = frame(0.5);
  other.plies[1].reaction.pop_back();
  EXPECT_THROW(ResultWriter(directory).write_frame(other), std::logic_error);
}

TEST_F(Results, ReactionsStandOnlyWhereAPlyIsHeld) {
  write_run(directory, {0.5});
  export_results(directory);
  EXPECT_TRUE(contains(content(directory / "export/90\u00b0 ply & co.vtu"), "reaction_N"));
  EXPECT_FALSE(contains(content(directory / "export/lower.vtu"), "reaction_N"));
}

} // namespace
} // namespace plyform::result_writer_test
