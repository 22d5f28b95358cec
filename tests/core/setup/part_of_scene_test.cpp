// SPDX-License-Identifier: GPL-3.0-or-later
// symmetry = "scene": a part in the place of the whole, and what is shown of it.
#include "core/run/run.hpp"
#include "core/setup/part_of_scene.hpp"
#include "core/setup/prepare_case.hpp"
#include "support/case_files.hpp"

#include <cmath>
#include <cstring>
#include <gtest/gtest.h>

namespace plyform::part_of_scene_test {
namespace {

const std::string scene = PLYFORM_TEST_DATA "/symmetric/case.toml";

PreparedCase prepared_with(const std::vector<Override>& overrides) {
  PreparedCase prepared = prepare_case(scene, overrides);
  EXPECT_TRUE(prepared.value) << all_texts(prepared);
  return prepared;
}

RunResult run(const PreparedCase& prepared, int threads = 1, const RunHooks& hooks = {}) {
  return run_case(*prepared.value, threads, hooks, prepared.meshes);
}

std::vector<Override> with(std::vector<Override> overrides, const Override& more) {
  overrides.push_back(more);
  return overrides;
}

/// Of each node of one ply, its number in another; -1: it is not there.
std::vector<std::int32_t> same_nodes(const PlyFrame& one, const PlyFrame& other) {
  std::vector<std::int32_t> found;
  for (const Vec3& x : one.x0) {
    std::int32_t n = -1;
    for (std::size_t k = 0; k < other.x0.size(); ++k)
      if ((other.x0[k] - x).norm() < 1e-6) n = static_cast<std::int32_t>(k);
    found.push_back(n);
  }
  return found;
}

/// The triangle of these nodes, in any order.
std::size_t triangle_of(const PlyFrame& ply, Triangle nodes) {
  std::sort(nodes.begin(), nodes.end());
  for (std::size_t t = 0; t < ply.triangles.size(); ++t) {
    Triangle own = ply.triangles[t];
    std::sort(own.begin(), own.end());
    if (own == nodes) return t;
  }
  ADD_FAILURE() << "no such triangle";
  return 0;
}

void expect_same_ply(const PlyFrame& part, const PlyFrame& whole) {
  ASSERT_EQ(part.x.size(), whole.x.size());
  ASSERT_EQ(part.triangles.size(), whole.triangles.size());
  const std::vector<std::int32_t> node = same_nodes(part, whole);
  double moved = 0.0, off = 0.0;
  for (std::size_t n = 0; n < node.size(); ++n) {
    ASSERT_GE(node[n], 0) << part.x0[n].transpose();
    moved = std::max(moved, (part.x[n] - part.x0[n]).norm());
    off = std::max(off, (part.x[n] - whole.x[at(node[n])]).norm());
  }
  EXPECT_GT(moved, 8.0);
  EXPECT_LE(off, 2e-3 * moved) << part.name;
  std::vector<std::size_t> triangle;
  for (const Triangle& t : part.triangles) {
    const auto of = triangle_of(whole, {node[at(t[0])], node[at(t[1])], node[at(t[2])]});
    triangle.push_back(of);
    // round the same way
    const Triangle& other = whole.triangles[of];
    const auto k = static_cast<std::size_t>(std::find(other.begin(), other.end(), node[at(t[0])]) -
                                            other.begin());
    EXPECT_EQ(node[at(t[1])], other[(k + 1) % 3]);
  }
  std::map<std::string, std::vector<double>> numbers;
  std::map<std::string, std::vector<Vec3>> vectors;
  each_column(whole, [&]<class Values>(const Column& column, const Values& values) {
    if constexpr (std::is_same_v<Values, std::vector<double>>)
      numbers[column.name] = values;
    else
      vectors[column.name] = values;
  });
  each_column(part, [&]<class Values>(const Column& column, const Values& values) {
    const bool of_nodes = column.location == Location::node;
    const auto place = [&](std::size_t i) { return of_nodes ? at(node[i]) : triangle[i]; };
    if (values.empty() || column.name == "wrinkle_height_mm" || column.name == "reaction_N") return;
    double largest = 0.0, sum = 0.0, scale = 1e-6;
    for (std::size_t i = 0; i < values.size(); ++i) {
      double difference = 0.0, size = 0.0;
      if constexpr (std::is_same_v<Values, std::vector<double>>)
        difference = values[i] - numbers[column.name][place(i)],
        size = numbers[column.name][place(i)];
      else
        difference = (values[i] - vectors[column.name][place(i)]).norm(), size = values[i].norm();
      largest = std::max(largest, std::abs(difference));
      sum += difference * difference, scale = std::max(scale, std::abs(size));
    }
    const double rms = std::sqrt(sum / static_cast<double>(values.size()));
    // the whole is as far from its own mirror images
    EXPECT_LE(rms, 0.015 * scale) << part.name << " " << column.name << ", at most " << largest;
  });
}

void expect_same(const RunResult& part, const RunResult& whole) {
  EXPECT_EQ(part.summary.status, whole.summary.status)
      << part.summary.message << whole.summary.message;
  for (std::size_t p = 0; p < whole.last.plies.size(); ++p)
    expect_same_ply(part.last.plies[p], whole.last.plies[p]);
  for (std::size_t t = 0; t < whole.last.tools.size(); ++t) {
    const ToolFrame &one = part.last.tools[t], &other = whole.last.tools[t];
    EXPECT_NEAR(one.force_N, other.force_N, 0.01 * std::abs(other.force_N) + 0.05) << one.name;
    EXPECT_LE((one.force - other.force).norm(), 0.01 * other.force.norm() + 0.05) << one.name;
    EXPECT_NEAR(one.stroke_mm, other.stroke_mm, 0.01) << one.name;
  }
  ASSERT_EQ(part.last.boundaries.size(), whole.last.boundaries.size());
  for (std::size_t b = 0; b < whole.last.boundaries.size(); ++b) {
    const BoundaryFrame &one = part.last.boundaries[b], &other = whole.last.boundaries[b];
    EXPECT_EQ(one.name, other.name);
    EXPECT_NEAR(one.force_N, other.force_N, 0.01 * std::abs(other.force_N) + 0.01) << one.name;
    EXPECT_LE((one.force - other.force).norm(), 0.01 * other.force.norm() + 0.01) << one.name;
    EXPECT_NEAR(one.stroke_mm, other.stroke_mm, 0.02) << one.name;
  }
  const Energies &one = part.last.energy, &other = whole.last.energy;
  for (const EnergyTerm& term : energy_terms)
    EXPECT_NEAR(one.*term.value, other.*term.value, 0.01 * other.largest()) << term.name;
  for (std::size_t p = 0; p < whole.summary.plies.size(); ++p)
    EXPECT_NEAR(part.summary.plies[p].draw_in.mean(), whole.summary.plies[p].draw_in.mean(), 0.01);
}

TEST(PartOfScene, ShowsTheWhole) {
  const PreparedCase whole = prepared_with({});
  const PreparedCase part = prepared_with({{"symmetry", "scene"}});
  ASSERT_EQ(part.value->part_at.size(), 2u) << (part.warnings.empty() ? "" : part.warnings[0]);
  EXPECT_EQ(4 * part.meshes[0].triangles.size(), whole.meshes[0].triangles.size());
  const RunResult all = run(whole);
  expect_same(run(part), all);
  // at planes between x and y, at which plies at 0 degrees have their families exchanged
  const std::vector<Override> turned = {
      {"blanks.square.mesh", "crossed"}, {"ply.0.angle", "45.0"}, {"ply.1.angle", "0.0"}};
  const PreparedCase again = prepared_with(with(turned, {"symmetry", "scene"}));
  EXPECT_EQ(again.value->part_at.size(), 2u);
  expect_same(run(again), run(prepared_with(turned)));
}

TEST(PartOfScene, IsTheSameForAnyThreadsAndGoesOnFromACheckpoint) {
  const PreparedCase part = prepared_with({{"symmetry", "scene"}, {"solver.duration", "0.01"}});
  std::string state;
  Frame before;
  RunHooks hooks;
  hooks.frame = [&](const Frame& frame) {
    if (state.empty()) before = frame;
  };
  hooks.marks = {2, [&](int number, const Scene&, const std::function<std::string()>& save) {
                   if (number == 1) state = save();
                 }};
  const RunResult one = run(part, 1, hooks), two = run(part, 2);
  const Resume resume{state, before};
  RunHooks goes_on;
  goes_on.resume = &resume;
  const RunResult later = run(part, 2, goes_on);
  for (const RunResult* other : {&two, &later})
    for (std::size_t p = 0; p < one.last.plies.size(); ++p) {
      const std::vector<Vec3>&a = one.last.plies[p].x, &b = other->last.plies[p].x;
      ASSERT_EQ(a.size(), b.size());
      EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof(Vec3)), 0);
    }
}

TEST(PartOfScene, SaysWhyAllIsModelled) {
  const auto warning_of = [](const std::vector<Override>& overrides) {
    const PreparedCase prepared = prepared_with(with(overrides, {"symmetry", "scene"}));
    EXPECT_TRUE(prepared.value->part_at.empty());
    std::string all;
    for (const std::string& text : prepared.warnings)
      all += text + "\n";
    return all;
  };
  EXPECT_NE(warning_of({{"ply.0.angle", "0.5"}}).find("x = 0 is broken by ply lower"),
            std::string::npos);
  EXPECT_NE(warning_of({{"fabrics.weave.weft.stiffness", "1020.0"}}).find("symmetry = \"alike\""),
            std::string::npos);
  const PreparedCase alike =
      prepared_with({{"fabrics.weave.weft.stiffness", "1020.0"}, {"symmetry", "alike"}});
  EXPECT_EQ(alike.value->part_at.size(), 2u);
  EXPECT_EQ(alike.notes.size(), 3u);
  EXPECT_EQ(alike.value->fabrics[0].families[1].tension.stiffness, 1000.0);
  const PreparedCase half =
      prepared_with({{"tool.0.position", "[0.0, 0.05, 31.2]"}, {"symmetry", "scene"}});
  EXPECT_EQ(half.value->part_at.size(), 1u); // the other plane holds
}

} // namespace
} // namespace plyform::part_of_scene_test
