// SPDX-License-Identifier: GPL-3.0-or-later
// tests/python/results_vtk_test.py opens the exported files with VTK.
#include "core/results/export.hpp"
#include "tests/support/results_helpers.hpp"

#include <cstdint>
#include <cstring>
#include <fmt/format.h>
#include <functional>
#include <gtest/gtest.h>
#include <hdf5.h>
#include <limits>

namespace plyform::export_test {
namespace {

using namespace results_test;
using ResultsExport = ResultFolder;

TEST_F(ResultsExport, ExportSaysWhatIsWrongWithAFolder) {
  const std::string missing = error_of([&] { export_results(directory); });
  EXPECT_TRUE(contains(missing, "results.h5: no such file")) << missing;
  write_run(directory, {0.5});
  const std::string whole = content(directory / "results.h5");
  put(directory / "results.h5", "no HDF5 at all");
  const std::string other = error_of([&] { export_results(directory); });
  EXPECT_TRUE(contains(other, "results.h5: cannot be opened")) << other;
  put(directory / "results.h5", whole.substr(0, whole.size() / 2));
  const std::string half = error_of([&] { export_results(directory); });
  EXPECT_TRUE(contains(half, "results.h5: cannot be opened")) << half;
}

/// Puts `values` in the place of the dataset `where` (none: only removes it).
void replace_dataset(const fs::path& path, const char* where, const std::vector<double>& values) {
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  ASSERT_GE(H5Ldelete(file, where, H5P_DEFAULT), 0) << where;
  if (!values.empty()) {
    const hsize_t size[2] = {values.size() / 3, 3};
    const hid_t space = H5Screate_simple(2, size, nullptr);
    const hid_t set =
        H5Dcreate2(file, where, H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    ASSERT_GE(H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), 0);
    H5Dclose(set);
    H5Sclose(space);
  }
  H5Fclose(file);
}

TEST_F(ResultsExport, ExportChecksWhatItReadsBeforeItUsesIt) {
  struct Damage {
    const char* where;
    std::vector<double> values;
    const char* rule;
  };
  for (const Damage& damage :
       {Damage{"/plies/lower/triangles", {0, 1, 16}, "names node 16 of 16"},
        Damage{"/plies/lower/triangles", {0, -1, 2}, "names node -1 of 16"},
        Damage{"/plies/lower/x0", {}, "is missing"},
        Damage{"/frames/000000/plies/lower/x", {1, 2, 3}, "has 1 rows"},
        Damage{"/frames/000000/plies/lower/warp", {1, 2, 3}, "has 1 rows"},
        Damage{"/frames/000000/plies/lower/warp_strain", {1, 2, 3}, "shape"},
        Damage{"/frames/000000", {}, "is missing"}, Damage{"/time_s", {}, "is missing"}}) {
    write_run(directory, {0.5});
    replace_dataset(directory / "results.h5", damage.where, damage.values);
    const std::string error = error_of([&] { export_results(directory); });
    EXPECT_TRUE(contains(error, (directory / "results.h5").string())) << error;
    EXPECT_TRUE(contains(error, damage.where)) << error;
    EXPECT_TRUE(contains(error, damage.rule)) << error;
    EXPECT_FALSE(fs::exists(directory / "export"));
  }
}

TEST_F(ResultsExport, ExportSaysWhatItCannotReadOfOtherLayouts) {
  const auto change = [&](const char* name, const char* rule,
                          const std::function<void(hid_t)>& put) {
    write_run(directory, {0.5});
    const hid_t file = H5Fopen((directory / "results.h5").c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    ASSERT_GE(H5Adelete(file, name), 0);
    put(file);
    H5Fclose(file);
    const std::string error = error_of([&] { export_results(directory); });
    EXPECT_TRUE(contains(error, rule)) << error;
    EXPECT_FALSE(fs::exists(directory / "export"));
  };
  const auto make = [](hid_t file, const char* name, hid_t type, hsize_t size, const void* values) {
    const hid_t space = H5Screate_simple(1, &size, nullptr);
    const hid_t made = H5Acreate2(file, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
    ASSERT_GE(H5Awrite(made, type, values), 0);
    H5Aclose(made);
    H5Sclose(space);
  };
  change("format_version", "format_version is missing", [](hid_t) {});
  change("format_version", "version 1, this plyform reads version 3: run the case again",
         [&](hid_t file) {
           const std::int64_t before = 1;
           make(file, "format_version", H5T_NATIVE_INT64, 1, &before);
         });
  change("tools", "/:tools is no list of names", [&](hid_t file) { // as version 1 had them
    const hid_t type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, H5T_VARIABLE);
    const char* names[] = {"punch", "die"};
    make(file, "tools", type, 2, names);
    H5Tclose(type);
  });
  change("plies", "/:plies is no list of names", [&](hid_t file) {
    const double numbers[] = {1.0, 2.0};
    make(file, "plies", H5T_NATIVE_DOUBLE, 2, numbers);
  });
}

/// Puts an attribute of variable length in the place of `name` of the object `where`.
void make_variable(const fs::path& path, const char* where, const char* name, bool numbers) {
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  ASSERT_GE(H5Adelete_by_name(file, where, name, H5P_DEFAULT), 0) << where;
  const hid_t type = numbers ? H5Tvlen_create(H5T_NATIVE_DOUBLE) : H5Tcopy(H5T_C_S1);
  if (!numbers) H5Tset_size(type, H5T_VARIABLE);
  const hid_t space = H5Screate(H5S_SCALAR);
  const hid_t made =
      H5Acreate_by_name(file, where, name, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  double values[] = {1.0, 2.0, 3.0};
  const hvl_t list{3, values};
  const char* text = "two";
  ASSERT_GE(H5Awrite(made, type, numbers ? static_cast<const void*>(&list) : &text), 0);
  H5Aclose(made), H5Sclose(space), H5Tclose(type), H5Fclose(file);
}

TEST_F(ResultsExport, AttributesOfVariableLengthAreNoNumbers) {
  for (const bool numbers : {false, true})
    for (const auto& [where, name] :
         {std::pair("/", "format_version"), std::pair("/plies/lower", "angle_deg"),
          std::pair("/frames/000000", "stroke_mm"), std::pair("/frames/000000", "step"),
          std::pair("/frames/000000/tools/punch", "force_N")}) {
      write_run(directory, {0.5});
      make_variable(directory / "results.h5", where, name, numbers);
      const std::string error = error_of([&] { export_results(directory); });
      EXPECT_TRUE(contains(error, std::string(name) + " holds no numbers")) << error;
    }
}

TEST_F(ResultsExport, NumbersThatAreNotFiniteAreRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  write_run(directory, {0.5});
  const Frame whole = read_last_frame(directory / "results.h5");
  for (const double bad : {nan, std::numeric_limits<double>::infinity()}) {
    std::vector<double> values(3 * whole.plies[0].x.size(), 1.0);
    values[7] = bad;
    write_run(directory, {0.5});
    replace_dataset(directory / "results.h5", "/frames/000000/plies/lower/x", values);
    const std::string error = error_of([&] { export_results(directory); });
    EXPECT_TRUE(contains(error, "/frames/000000/plies/lower/x holds a number that is not finite"))
        << error;
    EXPECT_FALSE(fs::exists(directory / "export"));
  }
  write_run(directory, {0.5});
  const hid_t file = H5Fopen((directory / "results.h5").c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  const hid_t ply = H5Gopen2(file, "/plies/lower", H5P_DEFAULT);
  const hid_t angle = H5Aopen(ply, "angle_deg", H5P_DEFAULT);
  ASSERT_GE(H5Awrite(angle, H5T_NATIVE_DOUBLE, &nan), 0);
  H5Aclose(angle), H5Gclose(ply), H5Fclose(file);
  const std::string error = error_of([&] { export_results(directory); });
  EXPECT_TRUE(contains(error, "/plies/lower:angle_deg holds a number that is not finite")) << error;
}

/// Bytes of a file changed one after the other: each is refused with the file's name, or read, and
/// nothing goes down or on for ever.
TEST_F(ResultsExport, DamagedBytesAreRefusedOrRead) {
  write_run(directory, {0.5});
  const fs::path path = directory / "results.h5";
  const std::string whole = content(path);
  std::size_t refused = 0;
  const std::size_t stride = std::max<std::size_t>(1, whole.size() / 200);
  for (std::size_t at = 0; at < whole.size(); at += stride)
    for (const char by : {'\xff', '\0'}) {
      std::string damaged = whole;
      damaged[at] = by;
      if (damaged[at] == whole[at]) continue;
      put(path, damaged);
      const std::string error = error_of([&] { read_last_frame(path); });
      if (error.empty()) continue;
      ++refused;
      EXPECT_TRUE(contains(error, path.string())) << at << ": " << error;
    }
  EXPECT_GT(refused, 20u);
}

TEST_F(ResultsExport, ExportWritesNowhereButInItsFolder) {
  write_run(directory, {0.5});
  const hid_t file = H5Fopen((directory / "results.h5").c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  const hid_t links = H5Pcreate(H5P_LINK_CREATE);
  H5Pset_create_intermediate_group(links, 1);
  for (const std::string group : {"/plies/", "/frames/000000/plies/"}) // ".." is a name to HDF5
    ASSERT_GE(H5Lmove(file, (group + "lower").c_str(), file, (group + "../../out").c_str(), links,
                      H5P_DEFAULT),
              0);
  const hid_t names = H5Aopen(file, "plies", H5P_DEFAULT);
  const hid_t type = H5Aget_type(names);
  const std::size_t length = H5Tget_size(type); // of the longer name
  std::string outside = "../../out" + std::string(length - 9, '\0') + "90\u00b0 ply & co";
  ASSERT_EQ(outside.size(), 2 * length);
  ASSERT_GE(H5Awrite(names, type, outside.data()), 0);
  H5Aclose(names);
  H5Tclose(type);
  H5Pclose(links);
  H5Fclose(file);
  const std::string error = error_of([&] { export_results(directory); });
  EXPECT_TRUE(contains(error, "\"../../out\" cannot be a file name")) << error;
  EXPECT_FALSE(fs::exists(directory / "export"));
}

TEST_F(ResultsExport, ExportWritesTheLastStateOfEachPlyAndTool) {
  write_run(directory, {0.0, 0.5});
  const std::vector<fs::path> files = export_results(directory);
  std::vector<std::string> names;
  for (const fs::path& file : files)
    names.push_back(fs::relative(file, directory / "export").string());
  std::sort(names.begin(), names.end());
  EXPECT_EQ(names, files_in(directory / "export"));
  EXPECT_EQ(names, (std::vector<std::string>{"90\u00b0 ply & co.csv", "90\u00b0 ply & co.stl",
                                             "90\u00b0 ply & co.vtu", "die.stl", "lower.csv",
                                             "lower.stl", "lower.vtu", "punch.stl"}));
  EXPECT_EQ(content(directory / "export/lower.csv"), content(directory / "plies/lower.csv"));
}

TEST_F(ResultsExport, ExportWritesTheStatesAndFormatsAskedFor) {
  write_run(directory, {0.0, 0.5, 1.0});
  EXPECT_EQ(count_frames(directory / "results.h5"), 3);
  ExportChoice choice{false, false, true, true, {}};
  EXPECT_EQ(export_results(directory, choice).size(), 6u);
  EXPECT_EQ(
      files_in(directory / "export"),
      (std::vector<std::string>{"90\u00b0 ply & co_000000.csv", "90\u00b0 ply & co_000001.csv",
                                "90\u00b0 ply & co_000002.csv", "lower_000000.csv",
                                "lower_000001.csv", "lower_000002.csv"}));
  EXPECT_EQ(content(directory / "export/lower_000002.csv"), content(directory / "plies/lower.csv"));
  EXPECT_NE(content(directory / "export/lower_000000.csv"), content(directory / "plies/lower.csv"));
  fs::remove_all(directory / "export");
  choice = {true, false, false, false, 1};
  EXPECT_EQ(export_results(directory, choice).size(), 2u);
  EXPECT_TRUE(fs::exists(directory / "export/lower_000001.vtu"));
  for (const auto& [frame, words] : {std::pair{3L, "has no frame 3, but 3 from 0"},
                                     std::pair{-4L, "there is no frame -4: states are numbered"}}) {
    choice.frame = frame;
    const std::string error = error_of([&] { export_results(directory, choice); });
    EXPECT_TRUE(contains(error, words)) << error;
  }
}

TEST_F(ResultsExport, ExportedToolStandsWhereItEndedAndFacesOutward) {
  write_run(directory, {0.0, 0.5});
  export_results(directory);
  const std::string stl = content(directory / "export/punch.stl");
  std::uint32_t count = 0;
  std::memcpy(&count, stl.data() + 80, 4);
  ASSERT_EQ(count, 8u);
  ASSERT_EQ(stl.size(), 84u + 50u * count);
  for (std::uint32_t i = 0; i < count; ++i) {
    float values[12];
    std::memcpy(values, stl.data() + 84 + 50 * i, sizeof values);
    EXPECT_EQ(values[2], 1.0f) << "normal of the flat punch, counter-clockwise from above";
    for (const int corner : {0, 1, 2})
      EXPECT_EQ(values[3 + 3 * corner + 2], 5.0f) << "30 mm at the start less 25 mm of stroke";
  }
}

} // namespace
} // namespace plyform::export_test
