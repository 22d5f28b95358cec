// SPDX-License-Identifier: GPL-3.0-or-later
// Meshes from the scene: the scout's sizes, the same for any number of threads, and taken from the
// file of a run before.
#include "core/mesh/size_field.hpp"
#include "core/setup/scene_mesh.hpp"
#include "support/case_files.hpp"

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>
#include <optional>
#include <unistd.h>

namespace plyform::scene_mesh_test {
namespace {

PreparedCase small_hemisphere(const std::string& from) {
  return prepare_case(PLYFORM_CASES "/verify/hemisphere_small.toml",
                      {{"blanks.square.mesh_from", from},
                       {"blanks.square.element_size", "8.5"},
                       {"tool.1.points", "[[34.0, -60.0], [34.0, 0.0, 8.0], [160.0, 0.0]]"}});
}

bool same(const std::vector<BlankMesh>& a, const std::vector<BlankMesh>& b) {
  for (std::size_t p = 0; p < a.size(); ++p)
    if (a[p].x != b[p].x || a[p].triangles != b[p].triangles) return false;
  return a.size() == b.size();
}

TEST(SceneMesh, IsFineOverTheDieTheSameForAnyThreadsAndTakenFromAFile) {
  PreparedCase one = small_hemisphere("scene"), two = small_hemisphere("scene");
  ASSERT_TRUE(one.value) << all_texts(one);
  const std::string before = one.identity;
  const SceneMesh found = mesh_from_scene(one, 1), again = mesh_from_scene(two, 2);
  EXPECT_TRUE(found.scouted);
  EXPECT_LT(found.smallest, 4.5); // a fillet of 8 mm
  EXPECT_GT(found.largest, 5.0);
  EXPECT_LT(found.largest, 8.6); // cells are as many as go into a side
  EXPECT_TRUE(same(one.meshes, two.meshes));
  EXPECT_EQ(one.identity, two.identity);
  EXPECT_NE(one.identity, before);

  const fs::path file =
      fs::temp_directory_path() / ("plyform_scene_mesh_" + std::to_string(getpid()));
  write_sizes(file, found.sizes);
  PreparedCase later = small_hemisphere(file.string());
  const SceneMesh taken = mesh_from_scene(later, 1);
  fs::remove(file);
  EXPECT_FALSE(taken.scouted);
  EXPECT_TRUE(same(one.meshes, later.meshes));
}

TEST(SceneMesh, IsOfWhatTheScoutHadSeenAtItsBudget) {
  PreparedCase whole = small_hemisphere("scene"), bounded = small_hemisphere("scene");
  ASSERT_TRUE(bounded.value) << all_texts(bounded);
  const SceneMesh all = mesh_from_scene(whole, 1);
  const SceneMesh found =
      mesh_from_scene(bounded, 1, {.scout = {.most_work = 0.5 * all.scout_work}});
  ASSERT_TRUE(bounded.value) << all_texts(bounded);
  EXPECT_TRUE(found.scouted);
  EXPECT_GE(found.scout_work, 0.5 * all.scout_work);
  EXPECT_LT(found.scout_work, 0.7 * all.scout_work);
  ASSERT_EQ(found.warnings.size(), all.warnings.size() + 1);
  EXPECT_NE(found.warnings[0].find("was ended at its budget"), std::string::npos);
  EXPECT_LT(found.smallest, found.largest); // the plies have met the die
  EXPECT_LE(found.triangles, all.triangles);
}

TEST(SceneMesh, IsUnknownWithoutAScout) {
  PreparedCase prepared = small_hemisphere("scene");
  ASSERT_TRUE(prepared.value) << all_texts(prepared);
  const std::vector<BlankMesh> before = prepared.meshes;
  const SceneMesh found = mesh_from_scene(prepared, 1, {.scouts = false});
  EXPECT_TRUE(found.unknown);
  EXPECT_TRUE(found.sizes.empty());
  EXPECT_TRUE(prepared.value);
  EXPECT_TRUE(same(before, prepared.meshes));
}

/// The cache folder of this test, and the one before again at its end.
class CacheFolder {
public:
  CacheFolder() {
    if (const char* set = std::getenv("XDG_CACHE_HOME")) before_ = set;
    setenv("XDG_CACHE_HOME", path.c_str(), 1);
  }
  ~CacheFolder() {
    if (before_)
      setenv("XDG_CACHE_HOME", before_->c_str(), 1);
    else
      unsetenv("XDG_CACHE_HOME");
    fs::remove_all(path);
  }
  std::vector<fs::path> files() const {
    std::vector<fs::path> found;
    for (const auto& entry : fs::directory_iterator(path / "plyform"))
      found.push_back(entry.path());
    return found;
  }
  const fs::path path =
      fs::temp_directory_path() / ("plyform_kept_sizes_" + std::to_string(getpid()));

private:
  std::optional<std::string> before_;
};

TEST(KeptSizes, SpareTheNextScoutOfTheSameCase) {
  const CacheFolder cache;
  PreparedCase first = small_hemisphere("scene"), again = small_hemisphere("scene");
  ASSERT_TRUE(first.value) << all_texts(first);
  const SceneMesh found = mesh_from_scene(first, 1, {.kept = true});
  EXPECT_TRUE(found.scouted);
  const SceneMesh kept = mesh_from_scene(again, 1, {.kept = true, .scouts = false});
  EXPECT_FALSE(kept.unknown);
  EXPECT_FALSE(kept.scouted);
  EXPECT_TRUE(kept.kept);
  EXPECT_EQ(kept.warnings, found.warnings);
  EXPECT_EQ(first.identity, again.identity);
  EXPECT_TRUE(same(first.meshes, again.meshes));

  PreparedCase other = prepare_case(PLYFORM_CASES "/verify/hemisphere_small.toml",
                                    {{"blanks.square.mesh_from", "scene"}});
  EXPECT_TRUE(mesh_from_scene(other, 1, {.kept = true, .scouts = false}).unknown);
}

TEST(KeptSizes, AreFoundAnewWhereTheirFileIsDamaged) {
  const CacheFolder cache;
  PreparedCase first = small_hemisphere("scene"), again = small_hemisphere("scene");
  mesh_from_scene(first, 1, {.kept = true});
  const std::vector<fs::path> files = cache.files();
  ASSERT_EQ(files.size(), 2u); // sizes, and the sum of their bytes
  const fs::path sizes = files[fs::file_size(files[0]) > fs::file_size(files[1]) ? 0 : 1];
  std::fstream file(sizes, std::ios::in | std::ios::out);
  file.seekg(200);
  const int there = file.get();
  file.seekp(200) << (there == '7' ? '8' : '7');
  file.close();
  EXPECT_TRUE(mesh_from_scene(again, 1, {.kept = true, .scouts = false}).unknown);
  const SceneMesh anew = mesh_from_scene(again, 1, {.kept = true});
  EXPECT_TRUE(anew.scouted);
  EXPECT_TRUE(same(first.meshes, again.meshes));
}

TEST(KeptSizes, RememberThatTheBudgetHasEndedTheScout) {
  const CacheFolder cache;
  PreparedCase first = small_hemisphere("scene"), again = small_hemisphere("scene");
  const SceneMesh found = mesh_from_scene(first, 1, {.kept = true, .scout = {.most_work = 1e5}});
  ASSERT_FALSE(found.warnings.empty());
  const SceneMesh kept = mesh_from_scene(again, 1, {.kept = true});
  EXPECT_TRUE(kept.kept);
  EXPECT_EQ(kept.warnings, found.warnings);
  EXPECT_TRUE(same(first.meshes, again.meshes));
}

TEST(SceneMesh, OfAFileWithoutSizesIsAMistakeOfTheCase) {
  PreparedCase lost = small_hemisphere((data_folder / "good/base.toml").string());
  ASSERT_TRUE(lost.value) << all_texts(lost);
  mesh_from_scene(lost, 1);
  EXPECT_FALSE(lost.value);
  ASSERT_EQ(lost.errors.size(), 1u) << all_texts(lost);
  EXPECT_EQ(lost.errors[0].item, "blanks.square.mesh_from");
}

/// The least size that is asked for on a ray from the middle of the blank.
double least_on_ray(const SizeGrid& grid, double angle) {
  SizeField field;
  field.largest = std::numeric_limits<double>::infinity();
  field.grid = grid;
  double least = field.largest;
  for (double r = 30.0; r < 68.0; r += 0.5)
    least = std::min(least, wanted_size(field, r * Vec2(std::cos(angle), std::sin(angle))));
  return least;
}

// Elements of 50 mm over a punch of 30 mm see little: two of their four places per triangle are in
// the hole. What is found must be fine on every ray all the same.
TEST(SceneMesh, LooksAgainWhereElementsAreTooCoarseToSayWhere) {
  PreparedCase coarse =
      prepare_case(PLYFORM_CASES "/verify/hemisphere_small.toml",
                   {{"blanks.square.mesh_from", "scene"},
                    {"blanks.square.element_size", "34"},
                    {"tool.1.points", "[[34.0, -60.0], [34.0, 0.0, 4.0], [160.0, 0.0]]"}});
  ASSERT_TRUE(coarse.value) << all_texts(coarse);
  const SceneMesh found = mesh_from_scene(coarse, 1);
  EXPECT_GT(found.largest, 3.0 * found.smallest);
  EXPECT_LT(found.smallest, 2.5); // a fillet of 4 mm
  for (int k = 0; k < 16; ++k)
    EXPECT_LT(least_on_ray(found.sizes[0].sizes, k * std::numbers::pi / 8.0), 2.5) << k;
}

} // namespace
} // namespace plyform::scene_mesh_test
