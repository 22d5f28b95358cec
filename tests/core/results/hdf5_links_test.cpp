// SPDX-License-Identifier: GPL-3.0-or-later
// A results.h5 that takes numbers from other files: of somebody who wants them in what is exported,
// or the reader to wait for ever.
#include "core/results/checkpoint_file.hpp"
#include "core/results/export.hpp"
#include "support/results_helpers.hpp"

#include <hdf5.h>
#include <sys/stat.h>

namespace plyform::hdf5_links_test {
namespace {

using namespace results_test;

const std::string dataset = "/frames/000000/plies/lower/shear_angle_deg";

class Hdf5Links : public ResultFolder {
protected:
  /// Changes results.h5 of a run of one state by `change`(file) and returns what is said of it.
  template <class Change>
  std::string said_after(const Change& change) {
    fs::remove_all(directory);
    write_run(directory, {0.5});
    const hid_t file = H5Fopen((directory / "results.h5").c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    change(file);
    H5Fclose(file);
    const std::string said = error_of([&] { export_results(directory); });
    EXPECT_FALSE(fs::exists(directory / "export"));
    return said;
  }
  std::size_t triangles() const { return frame(0.5).plies[0].triangles.size(); }
};

/// Puts a dataset made by `made` in the place of the shear angles.
void replace(hid_t file, hid_t made, hsize_t rows) {
  ASSERT_GE(H5Ldelete(file, dataset.c_str(), H5P_DEFAULT), 0);
  const hid_t space = H5Screate_simple(1, &rows, nullptr);
  const hid_t set =
      H5Dcreate2(file, dataset.c_str(), H5T_IEEE_F64LE, space, H5P_DEFAULT, made, H5P_DEFAULT);
  ASSERT_GE(set, 0);
  H5Dclose(set), H5Sclose(space), H5Pclose(made);
}

TEST_F(Hdf5Links, NumbersInOtherFilesAreRefused) {
  const std::string said = said_after([&](hid_t file) {
    put(directory / "secret", std::string(8 * triangles(), '\x01'));
    const hid_t made = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_external(made, (directory / "secret").c_str(), 0, 8 * triangles());
    replace(file, made, triangles());
  });
  EXPECT_TRUE(contains(said, dataset + " takes its numbers from another file")) << said;
}

TEST_F(Hdf5Links, NumbersInOtherDatasetsAreRefused) {
  const std::string said = said_after([&](hid_t file) {
    const hsize_t rows = triangles();
    const hid_t made = H5Pcreate(H5P_DATASET_CREATE), space = H5Screate_simple(1, &rows, nullptr);
    H5Pset_virtual(made, space, (directory / "other.h5").c_str(), "/x", space);
    H5Sclose(space);
    replace(file, made, rows);
  });
  EXPECT_TRUE(contains(said, dataset + " takes its numbers from other datasets")) << said;
}

TEST_F(Hdf5Links, LinksToOtherFilesAreRefused) {
  for (const std::string& part : {dataset, std::string("/plies/lower/x0"), std::string("/plies"),
                                  std::string("/frames/000000"), std::string("/time_s")})
    for (const std::string& to : {std::string("other.h5"), std::string("states/000000.h5")}) {
      const std::string said = said_after([&](hid_t file) {
        fs::create_directory(directory / "states");
        fs::copy(directory / "results.h5", directory / to);
        ASSERT_GE(H5Ldelete(file, part.c_str(), H5P_DEFAULT), 0);
        // an object that is not the one of that name, as the file's own links would have it
        ASSERT_GE(H5Lcreate_external(to.c_str(), (part + "/.").c_str(), file, part.c_str(),
                                     H5P_DEFAULT, H5P_DEFAULT),
                  0);
      });
      EXPECT_TRUE(contains(said, part + " is a link to another file")) << said;
    }
  const std::string said = said_after([&](hid_t file) {
    ASSERT_GE(H5Lmove(file, dataset.c_str(), file, "/elsewhere", H5P_DEFAULT, H5P_DEFAULT), 0);
    ASSERT_GE(H5Lcreate_soft("/elsewhere", file, dataset.c_str(), H5P_DEFAULT, H5P_DEFAULT), 0);
  });
  EXPECT_TRUE(contains(said, dataset + " is a link to something else")) << said;
}

TEST_F(Hdf5Links, ARunInProgressHasLinksToItsOwnStates) {
  ResultWriter writer(directory);
  for (const double time : {0.0, 0.5})
    writer.write_frame(frame(time));
  ASSERT_EQ(export_results(directory).empty(), false);
  const fs::path state = directory / "states" / "000001.h5";
  fs::rename(state, directory / "other.h5");
  fs::create_symlink("../other.h5", state);
  fs::remove_all(directory / "export");
  std::string said = error_of([&] { export_results(directory); });
  EXPECT_TRUE(contains(said, "/frames/000001 is a link to what is no file")) << said;
  fs::remove(state);
  ASSERT_EQ(mkfifo(state.c_str(), 0600), 0);
  said = error_of([&] { export_results(directory); });
  EXPECT_TRUE(contains(said, "/frames/000001 is a link to what is no file")) << said;
}

TEST_F(Hdf5Links, PipesAreRefusedAndNotWrittenInto) {
  fs::create_directories(directory);
  ASSERT_EQ(mkfifo((directory / "results.h5").c_str(), 0600), 0);
  const std::string said = error_of([&] { export_results(directory); });
  EXPECT_TRUE(contains(said, "results.h5: is a pipe, not a file")) << said;
  fs::remove(directory / "results.h5");
  for (const char* name : {"summary.json.tmp", "results.h5.tmp", "history.csv.tmp"})
    ASSERT_EQ(mkfifo((directory / name).c_str(), 0600), 0);
  put(directory / "mine", "mine");
  fs::create_symlink("mine", directory / "results.xdmf.tmp");
  write_run(directory, {0.5}); // would wait for a reader, or write into `mine`
  EXPECT_EQ(error_of([&] { export_results(directory); }), "");
  EXPECT_EQ(content(directory / "mine"), "mine");
}

/// A checkpoint with one field of the writer's part changed, and its sum right.
TEST_F(Hdf5Links, CheckpointsAreCheckedWhateverTheirSumSays) {
  fs::create_directories(directory);
  const fs::path file = directory / "checkpoint";
  const auto refusal = [&](const auto& change) {
    WriterState state;
    state.states = {{"a", "b"},
                    {"t"},
                    {"g"},
                    {0.0, 0.5},
                    {0.0, 1.0},
                    {0, 10},
                    "a/9/8\nb/9/8\ntools\nt/9/8\nboundaries\ng\n"};
    state.history = "head\n1\n2\n";
    state.xdmf = {{"a", "b", "t"}, {"1", "2", "3"}};
    state.last_time = 0.5;
    state.last_step = 10;
    change(state);
    write_checkpoint_file(file, "case", state, "solver");
    return error_of([&] { read_checkpoint_file(file, "case"); });
  };
  EXPECT_EQ(refusal([](WriterState&) {}), "");
  EXPECT_NE(refusal([](WriterState& w) { w.xdmf.grids.pop_back(); }), "");
  EXPECT_NE(refusal([](WriterState& w) { w.xdmf.names[0] = "../a"; }), "");
  EXPECT_NE(refusal([](WriterState& w) { w.states.plies[0] = "../a"; }), "");
  EXPECT_NE(refusal([](WriterState& w) { w.states.time.pop_back(); }), "");
  EXPECT_NE(refusal([](WriterState& w) { w.states.time[1] = -1.0; }), "");
  EXPECT_NE(refusal([](WriterState& w) { w.states.step[1] = 0; }), "");
  EXPECT_NE(refusal([](WriterState& w) { w.states.stroke[1] = std::nan(""); }), "");
  EXPECT_NE(refusal([](WriterState& w) { w.last_step = 11; }), "");
  EXPECT_NE(refusal([](WriterState& w) { w.history += "3\n"; }), "");
  EXPECT_NE(refusal([](WriterState& w) { w.states = {}; }), "");
  put(file, "plyform checkpoint 1\n");
  EXPECT_TRUE(contains(error_of([&] { read_checkpoint_file(file, "case"); }),
                       "is no checkpoint of this version of plyform"));
}

} // namespace
} // namespace plyform::hdf5_links_test
