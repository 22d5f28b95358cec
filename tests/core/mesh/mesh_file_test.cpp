// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/blank_checks.hpp"

#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>
#include <limits>

namespace plyform::mesh_file_test {
namespace {

using namespace blank_checks;

/// A file with this content, removed at the end.
struct TestFile {
  std::filesystem::path path;
  TestFile(const std::string& extension, const std::string& content) {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    path = std::filesystem::path(::testing::TempDir()) /
           fmt::format("plyform_{}_{}_{}.{}", test->test_suite_name(), test->name(),
                       ::testing::UnitTest::GetInstance()->random_seed(), extension);
    std::ofstream(path, std::ios::binary) << content;
  }
  ~TestFile() { std::filesystem::remove(path); }
  TestFile(const TestFile&) = delete;
  TestFile& operator=(const TestFile&) = delete;
};

BlankMesh read(const std::filesystem::path& file) {
  return mesh_blank({{}, MeshKind::file, 0, file}, 0, 0);
}

/// What is said about a file, without its name.
std::string error_of(const std::string& extension, const std::string& content) {
  const TestFile file(extension, content);
  std::string message = message_of([&] { read(file.path); });
  const std::string start = fmt::format("blank file {}: ", file.path.string());
  EXPECT_EQ(message.compare(0, start.size(), start), 0) << message;
  return message.size() < start.size() ? message : message.substr(start.size());
}

std::string off(const std::vector<Vec3>& x, const std::vector<std::vector<int>>& faces) {
  std::string text = fmt::format("OFF\n{} {} 0\n", x.size(), faces.size());
  for (const Vec3& p : x)
    text += fmt::format("{} {} {}\n", p.x(), p.y(), p.z());
  for (const auto& face : faces) {
    text += fmt::format("{}", face.size());
    for (const int n : face)
      text += fmt::format(" {}", n);
    text += "\n";
  }
  return text;
}

BlankMesh pierced_mesh() {
  return mesh_blank({pierced_l(), MeshKind::free, 40, {}}, 0, 0);
}

std::string as_off(const BlankMesh& mesh, double z) {
  std::vector<Vec3> x;
  for (const Vec2& p : mesh.x)
    x.emplace_back(p.x(), p.y(), z);
  std::vector<std::vector<int>> faces;
  for (const Triangle& t : mesh.triangles)
    faces.push_back({t[0], t[1], t[2]});
  return off(x, faces);
}

/// Every other triangle the wrong way round.
std::string as_ascii_stl(const BlankMesh& mesh, double z) {
  std::string text = "solid blank\n";
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    text += "facet normal 0 0 1\nouter loop\n";
    for (const std::size_t k : {0u, f % 2 ? 1u : 2u, f % 2 ? 2u : 1u}) {
      const Vec2& p = mesh.x[mesh.triangles[f][k]];
      text += fmt::format("vertex {} {} {}\n", p.x(), p.y(), z);
    }
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid blank\n";
}

std::string as_binary_stl(const BlankMesh& mesh, double z) {
  std::string bytes(80, ' ');
  const auto add = [&](auto value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  add(static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const Triangle& t : mesh.triangles) {
    for (const float n : {0.0f, 0.0f, 1.0f})
      add(n);
    for (const std::int32_t n : t) {
      const Vec2& p = mesh.x[n];
      for (const double c : {p.x(), p.y(), z})
        add(static_cast<float>(c));
    }
    add(std::uint16_t{0});
  }
  return bytes;
}

std::string as_obj(const BlankMesh& mesh, double z) {
  std::string text;
  for (const Vec2& p : mesh.x)
    text += fmt::format("v {} {} {}\n", p.x(), p.y(), z);
  for (const Triangle& t : mesh.triangles)
    text += fmt::format("f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1);
  return text;
}

std::string as_ply(const BlankMesh& mesh, double z) {
  std::string text = fmt::format(
      "ply\nformat ascii 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty "
      "double z\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
      mesh.x.size(), mesh.triangles.size());
  for (const Vec2& p : mesh.x)
    text += fmt::format("{} {} {}\n", p.x(), p.y(), z);
  for (const Triangle& t : mesh.triangles)
    text += fmt::format("3 {} {} {}\n", t[0], t[1], t[2]);
  return text;
}

TEST(BlankFromFile, IsBisectedWhereAZoneAsksForSmallerElements) {
  const TestFile file("off", as_off(pierced_mesh(), 0.0));
  BlankSpec spec{{}, MeshKind::file, 0, file.path};
  spec.zones.resize(1);
  spec.zones[0].centre = {250, 75}, spec.zones[0].radius = 20, spec.zones[0].element_size = 3;
  const BlankMesh coarse = read(file.path), fine = mesh_blank(spec, 0, 0);
  expect_sound(fine, pierced_l(), "bisected");
  EXPECT_GT(fine.triangles.size(), coarse.triangles.size() + 190); // 2 pi 20^2 over 2^(1/2) 3^2
  for (std::size_t n = 0; n < coarse.x.size(); ++n)
    EXPECT_EQ(fine.x[n], coarse.x[n]);
}

TEST(BlankFromFile, EveryFormatGivesTheMeshBack) {
  const BlankMesh mesh = pierced_mesh();
  for (const auto& [extension, content] :
       {std::pair<std::string, std::string>("off", as_off(mesh, 0)),
        {"stl", as_ascii_stl(mesh, 3.5)},
        {"OBJ", as_obj(mesh, -2)},
        {"ply", as_ply(mesh, 1e-3)}}) {
    const TestFile file(extension, content);
    const BlankMesh back = read(file.path);
    EXPECT_EQ(back.x.size(), mesh.x.size()) << extension;
    EXPECT_EQ(back.triangles.size(), mesh.triangles.size()) << extension;
    expect_sound(back, pierced_l(), extension);
  }
}

TEST(BlankFromFile, BinaryStlIsReadToSinglePrecision) {
  const BlankMesh mesh = pierced_mesh();
  const TestFile file("stl", as_binary_stl(mesh, 12.34));
  const BlankMesh back = read(file.path);
  ASSERT_EQ(back.x.size(), mesh.x.size());
  const Measures m = measure(back);
  EXPECT_NEAR(m.area, area(pierced_l()), 1e-6 * m.area); // floats: 6e-8 a coordinate
  EXPECT_GT(m.smallest_double_area, 0);
  EXPECT_EQ(m.rim_loops, 2u);
}

TEST(BlankFromFile, UnusedNodesAreDropped) {
  const TestFile file("off",
                      off({{9, 9, 0}, {0, 0, 0}, {1, 0, 0}, {7, 7, 0}, {0, 1, 0}}, {{1, 2, 4}}));
  const BlankMesh mesh = read(file.path);
  ASSERT_EQ(mesh.x.size(), 3u);
  EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}}));
  EXPECT_EQ(mesh.x[2], Vec2(0, 1));
}

TEST(BlankFromFile, UnreadableFilesAreNamed) {
  EXPECT_EQ(message_of([] { read("nowhere/blank.stl"); }),
            "blank file nowhere/blank.stl: there is no such file; check the path");
  EXPECT_EQ(message_of([] { read("nowhere/blank.step"); }),
            "blank file nowhere/blank.step: the extension '.step' is none of .stl, .obj, .ply and "
            ".off; mesh_tool.py PART.step -o PART.stl makes the mesh of a solid");
  EXPECT_EQ(error_of("off", "this is no mesh"),
            "line 1: no faces could be read as off: it begins with 'this', not with OFF; export "
            "the surface again, as three-dimensional text");
  EXPECT_EQ(error_of("obj", "# nothing\n"),
            "no faces could be read as obj: it is truncated, or holds other things than a surface; "
            "export the surface again");
}

TEST(BlankFromFile, EmptyAndTruncatedFilesAreRefused) {
  EXPECT_EQ(error_of("stl", "solid blank\nendsolid blank\n"),
            "holds no triangles; it may be cut short, export it again");
  const BlankMesh mesh = pierced_mesh();
  for (const auto& [extension, whole] :
       {std::pair<std::string, std::string>("stl", as_binary_stl(mesh, 0)),
        {"stl", as_ascii_stl(mesh, 0)},
        {"off", as_off(mesh, 0)},
        {"ply", as_ply(mesh, 0)}})
    for (const std::size_t tenths : {3u, 5u, 9u}) {
      const std::string error = error_of(extension, whole.substr(0, whole.size() * tenths / 10));
      EXPECT_TRUE(error.find("truncated") != std::string::npos ||
                  error.find("stands where an STL has") != std::string::npos)
          << extension << ": " << error;
    }
}

TEST(BlankFromFile, ANumberThatIsNoneIsNotTakenForAnother) {
  for (const std::string bad : {"nan", "inf", "-nan", "1e999"}) {
    const std::string facet = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 10 0 0\n"
                              "vertex 0 " +
                              bad + " 0\nendloop\nendfacet\n";
    EXPECT_EQ(error_of("stl", "solid a\n" + facet + "endsolid a\n"),
              "line 6: a coordinate is not a finite number; export the mesh again");
  }
  // Its second triangle used to begin at (0, 0), the point that a map finds for any nan.
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const BlankMesh square{{{0, 0}, {10, 0}, {10, 10}, {0, 10}, {nan, 0}}, {{0, 1, 2}, {4, 2, 3}}};
  EXPECT_EQ(error_of("stl", as_binary_stl(square, 0)),
            "facet 1: a coordinate is not a finite number; export the mesh again");
}

TEST(BlankFromFile, NodesBeyondAHundredMetresAreRefused) {
  EXPECT_EQ(error_of("off", off({{0, 0, 1}, {2e6, 0, 1}, {0, 10, 1}}, {{0, 1, 2}})),
            "node 1 of face 0 lies more than 100 m away; check the file's unit, which is "
            "taken for mm");
}

TEST(BlankFromFile, MustBeFlat) {
  EXPECT_EQ(error_of("off", off({{0, 0, 1}, {10, 0, 1}, {0, 10, 1.25}}, {{0, 1, 2}})),
            "is not flat, z runs from 1 to 1.25 mm; a blank needs the same z everywhere");
}

TEST(BlankFromFile, MustConsistOfTriangles) {
  EXPECT_EQ(error_of("off", off({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2, 3}})),
            "face 0 has 4 corners; export the mesh as triangles");
  EXPECT_EQ(
      error_of("off", off({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}}, {{0, 1, 3}, {0, 1, 2}})),
      "triangle 1 at (0, 0) has no area; collapse its shortest edge or mesh the blank again");
}

TEST(BlankFromFile, MustBeManifoldAndInOnePiece) {
  const std::vector<Vec3> x{{0, 0, 0},  {1, 0, 0},  {0, 1, 0},   {1, 1, 0},  {0.5, -1, 0},
                            {-1, 0, 0}, {0, -1, 0}, {-2, -1, 0}, {-1, -1, 0}};
  // The edge 0-1 with triangles above, below, above.
  EXPECT_EQ(error_of("off", off(x, {{0, 1, 2}, {1, 0, 4}, {0, 1, 3}})),
            "is not manifold, triangles overlap along the edge from (0, 0) to (1, 0): it is shared "
            "by more than two triangles or two on the same side; remove the surplus ones");
  EXPECT_EQ(error_of("off", off(x, {{0, 1, 2}, {0, 5, 6}})),
            "is not manifold, parts of it meet only in the node at (0, 0); join them along an edge "
            "or part them");
  EXPECT_EQ(error_of("off", off(x, {{0, 1, 2}, {5, 7, 8}})),
            "falls into separate pieces, one at (0, 0), one at (-1, 0); join nodes that should be "
            "one, or give each piece as a blank of its own");
}

} // namespace
} // namespace plyform::mesh_file_test
