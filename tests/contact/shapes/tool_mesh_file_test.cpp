// SPDX-License-Identifier: GPL-3.0-or-later
// Tool meshes read from files of every kind, whole and broken.
#include "support/shape_checks.hpp"

#include <bit>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>
#include <unistd.h>

namespace plyform::tool_mesh_file_test {
namespace {

using testing::ask;

/// A folder of its own for each test, removed after it.
class ToolMeshFile : public ::testing::Test {
protected:
  std::filesystem::path folder = std::filesystem::temp_directory_path() /
                                 ("plyform_tool_mesh_" + std::to_string(::getpid()) + "_" +
                                  ::testing::UnitTest::GetInstance()->current_test_info()->name());
  void SetUp() override { std::filesystem::create_directories(folder); }
  void TearDown() override { std::filesystem::remove_all(folder); }

  std::filesystem::path write(const std::string& name, const std::string& bytes) {
    std::ofstream(folder / name, std::ios::binary) << bytes;
    return folder / name;
  }
  void expect_rejected(const std::filesystem::path& file, const std::string& reason) {
    try {
      load_tool_mesh(file, 1.0, nullptr);
      ADD_FAILURE() << file << " accepted, expected: " << reason;
    } catch (const std::runtime_error& error) {
      const std::string text = error.what();
      EXPECT_NE(text.find(reason), std::string::npos) << text;
      EXPECT_NE(text.find(file.string()), std::string::npos) << text;
    }
  }
};

const Box box{Vec3(20, 14, 10)};

TriMesh box_mesh() {
  return tessellate(box, 5.0, 0.0);
}

std::string ascii_stl(const TriMesh& s) {
  std::ostringstream out;
  out << "solid box\n";
  for (const Triangle& t : s.triangles) {
    out << "facet normal nan nan nan\n outer loop\n"; // as some exporters write it
    for (const int i : t)
      out << "  vertex " << s.x[size_t(i)].transpose() << "\n";
    out << " endloop\nendfacet\n";
  }
  out << "endsolid box\n";
  return out.str();
}

template <class T>
void append(std::string& bytes, T value) {
  static_assert(std::endian::native == std::endian::little);
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

std::string binary_stl(const TriMesh& s, const std::string& title = "box") {
  std::string bytes = title;
  bytes.resize(80, ' ');
  append(bytes, static_cast<std::uint32_t>(s.triangles.size()));
  for (const Triangle& t : s.triangles) {
    for (int k = 0; k < 3; ++k)
      append(bytes, 0.0f);
    for (const int i : t)
      for (int k = 0; k < 3; ++k)
        append(bytes, static_cast<float>(s.x[size_t(i)][k]));
    append(bytes, std::uint16_t{0});
  }
  return bytes;
}

std::string obj(const TriMesh& s) {
  std::ostringstream out;
  out << "# box\n";
  for (const Vec3& x : s.x)
    out << "v " << x.transpose() << "\n";
  for (const Triangle& t : s.triangles)
    out << "f " << t[0] + 1 << " " << t[1] + 1 << " " << t[2] + 1 << "\n";
  return out.str();
}

std::string faces_of(const TriMesh& s) {
  std::ostringstream out;
  for (const Vec3& x : s.x)
    out << x.transpose() << "\n";
  for (const Triangle& t : s.triangles)
    out << "3 " << t[0] << " " << t[1] << " " << t[2] << "\n";
  return out.str();
}

std::string off(const TriMesh& s) {
  return "OFF\n" + std::to_string(s.x.size()) + " " + std::to_string(s.triangles.size()) + " 0\n" +
         faces_of(s);
}

std::string ply_header(const TriMesh& s, const std::string& format) {
  return "ply\nformat " + format + " 1.0\nelement vertex " + std::to_string(s.x.size()) +
         "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
         std::to_string(s.triangles.size()) +
         "\nproperty list uchar int vertex_indices\nend_header\n";
}

std::string ascii_ply(const TriMesh& s) {
  return ply_header(s, "ascii") + faces_of(s);
}

std::string binary_ply(const TriMesh& s) {
  std::string bytes = ply_header(s, "binary_little_endian");
  for (const Vec3& x : s.x)
    for (int k = 0; k < 3; ++k)
      append(bytes, x[k]);
  for (const Triangle& t : s.triangles) {
    append(bytes, std::uint8_t{3});
    for (const std::int32_t i : t)
      append(bytes, i);
  }
  return bytes;
}

TEST_F(ToolMeshFile, EveryFormatGivesTheSameBox) {
  const TriMesh s = box_mesh();
  for (const auto& file :
       {write("ascii.stl", ascii_stl(s)), write("binary.stl", binary_stl(s)),
        write("liar.stl", binary_stl(s, "solid but binary")), write("UPPER.STL", binary_stl(s)),
        write("box.obj", obj(s)), write("box.off", off(s)), write("ascii.ply", ascii_ply(s)),
        write("binary.ply", binary_ply(s))}) {
    SCOPED_TRACE(file);
    MeshReport report;
    const ToolShape mesh = load_tool_mesh(file, 1.0, &report);
    EXPECT_EQ(report.vertices, s.x.size());
    EXPECT_EQ(report.faces, s.triangles.size());
    EXPECT_TRUE(report.closed);
    EXPECT_FALSE(report.flipped);
    EXPECT_EQ(report.removed_degenerate, 0u);
    testing::RandomPoints random(1);
    for (int i = 0; i < 1000; ++i) {
      const Vec3 p = random.in(Box3(Vec3(-20, -20, -20), Vec3(20, 20, 20)));
      // Text with six digits and floats: 1e-5 mm of 10 mm.
      ASSERT_NEAR(ask(mesh, p).distance, ask(box, p).distance, 1e-5);
    }
  }
}

TEST_F(ToolMeshFile, QuadsAreSplit) {
  const auto file =
      write("quads.obj", "v 0 0 0\nv 10 0 0\nv 10 10 0\nv 0 10 0\nv 0 0 10\nv 10 0 10\n"
                         "v 10 10 10\nv 0 10 10\nf 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\n"
                         "f 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n");
  MeshReport report;
  const ToolShape mesh = load_tool_mesh(file, 1.0, &report);
  EXPECT_EQ(report.faces, 12u);
  EXPECT_TRUE(report.closed);
  EXPECT_NEAR(ask(mesh, Vec3(5, 5, 9)).distance, -1.0, 1e-14);
}

TEST_F(ToolMeshFile, FacesOfManyCornersAreSplitNotchesToo) {
  const std::filesystem::path file =
      write("angle.off", "OFF\n12 8 0\n0 0 0\n20 0 0\n20 5 0\n5 5 0\n5 20 0\n0 20 0\n"
                         "0 0 4\n20 0 4\n20 5 4\n5 5 4\n5 20 4\n0 20 4\n"
                         "6 5 4 3 2 1 0\n6 6 7 8 9 10 11\n4 0 1 7 6\n4 1 2 8 7\n4 2 3 9 8\n"
                         "4 3 4 10 9\n4 4 5 11 10\n4 5 0 6 11\n");
  MeshReport report;
  const ToolShape tool = load_tool_mesh(file, 1.0, &report);
  EXPECT_TRUE(report.closed);
  EXPECT_EQ(report.faces, 20u);
  EXPECT_NEAR(ask(tool, Vec3(2.5, 2.5, 2)).distance, -2.0, 1e-12);
  EXPECT_NEAR(ask(tool, Vec3(8, 9, 2)).distance, 3.0, 1e-12); // in the notch
  EXPECT_NEAR(ask(tool, Vec3(15, 2, 6)).distance, 2.0, 1e-12);
}

TEST_F(ToolMeshFile, ScaleTurnsMetresIntoMillimetres) {
  const auto file = write("box.off", off(box_mesh()));
  const ToolShape mesh = load_tool_mesh(file, 1000.0, nullptr);
  EXPECT_NEAR(ask(mesh, Vec3::Zero()).distance, -5000.0, 1e-9);
  for (const double scale : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(load_tool_mesh(file, scale, nullptr), std::runtime_error);
}

TEST_F(ToolMeshFile, InwardFileIsTurnedOutward) {
  TriMesh s = box_mesh();
  for (Triangle& t : s.triangles)
    std::swap(t[0], t[1]);
  MeshReport report;
  const ToolShape mesh = load_tool_mesh(write("inward.stl", binary_stl(s)), 1.0, &report);
  EXPECT_TRUE(report.flipped);
  EXPECT_NEAR(ask(mesh, Vec3::Zero()).distance, -5.0, 1e-6);
}

TEST_F(ToolMeshFile, MissingEmptyAndForeignFilesAreNamed) {
  expect_rejected(folder / "none.stl", "there is no such file");
  expect_rejected(write("empty.stl", ""), "the file is empty");
  expect_rejected(write("empty.obj", ""), "the file is empty");
  expect_rejected(write("part.step", "ISO-10303-21;"), "the extension '.step' is none of .stl");
  for (const char* solid : {"part.STEP", "part.stp", "part.igs", "part.iges"})
    expect_rejected(write(solid, "ISO-10303-21;"),
                    "mesh_tool.py PART.step -o PART.stl makes the mesh");
  expect_rejected(write("noextension", "x"), "the extension '' is none of");
  std::filesystem::create_directory(folder / "folder.stl");
  expect_rejected(folder / "folder.stl", "is a folder, not a file");
  expect_rejected(write("words.stl", std::string(200, 'x')),
                  "the file is truncated: its header promises");
  expect_rejected(write("words.off", "hello world\n"), "no faces could be read as off");
  expect_rejected(write("words.ply", "hello world\n"), "no faces could be read as ply");
  expect_rejected(write("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n"),
                  "no faces could be read as obj");
  expect_rejected(write("nothing.stl", "solid x\nendsolid x\n"), "it holds no faces");
}

TEST_F(ToolMeshFile, AFileThatTheDiskCannotReadIsNamed) {
  if (!std::filesystem::exists("/proc/self/mem")) GTEST_SKIP() << "no file here that fails";
  std::filesystem::create_symlink("/proc/self/mem", folder / "bad.stl");
  expect_rejected(folder / "bad.stl", "cannot be read: ");
}

TEST_F(ToolMeshFile, TruncatedFilesAreRejectedWhereverTheyEnd) {
  const TriMesh s = box_mesh();
  const std::vector<std::pair<std::string, std::string>> files{{"a.stl", ascii_stl(s)},
                                                               {"b.stl", binary_stl(s)},
                                                               {"c.off", off(s)},
                                                               {"d.ply", ascii_ply(s)},
                                                               {"e.ply", binary_ply(s)}};
  for (const auto& [name, bytes] : files)
    for (const double part : {0.001, 0.01, 0.02, 0.1, 0.3, 0.5, 0.77, 0.95}) {
      SCOPED_TRACE(part);
      expect_rejected(
          write(name, bytes.substr(0, static_cast<std::size_t>(part * double(bytes.size())) + 1)),
          "");
    }
  expect_rejected(write("half.stl", binary_stl(s).substr(0, 84 + 50 * 7 + 3)),
                  "the file is truncated: its header promises " +
                      std::to_string(s.triangles.size()) + " facets, it holds 7");
  expect_rejected(write("half.stl", ascii_stl(s).substr(0, 3000)),
                  "the file is truncated: no endsolid");
}

TEST_F(ToolMeshFile, NumbersThatAreNoneAreRejected) {
  const std::string reason = "not a finite number";
  const auto spoiled = [](std::string text, const std::string& number, const std::string& by) {
    return text.replace(text.find(number), number.size(), by);
  };
  const TriMesh s{{Vec3(1, 2, 3), Vec3(4.5, 6, 7), Vec3(1, 9, 3)}, {{0, 1, 2}}};
  for (const std::string bad : {"nan", "inf", "-NaN"}) {
    expect_rejected(write("a.stl", spoiled(ascii_stl(s), "4.5", bad)), reason);
    expect_rejected(write("a.obj", spoiled(obj(s), "4.5", bad)), reason);
    expect_rejected(write("a.off", spoiled(off(s), "4.5", bad)), reason);
    expect_rejected(write("a.ply", spoiled(ascii_ply(s), "4.5", bad)), reason);
  }
  TriMesh nan = s;
  nan.x[1].x() = std::numeric_limits<double>::quiet_NaN();
  expect_rejected(write("b.stl", binary_stl(nan)), reason);
  nan.x[1].x() = std::numeric_limits<double>::infinity();
  expect_rejected(write("b.ply", binary_ply(nan)), reason);
  expect_rejected(write("word.stl", spoiled(ascii_stl(s), "4.5", "four")),
                  "line 5: 'four' is not a number");
  expect_rejected(write("far.off", spoiled(off(s), "4.5", "4.5e9")), "more than 100 m away");
  expect_rejected(write("index.obj", spoiled(obj(s), "f 1", "f 9")), "");
}

TEST_F(ToolMeshFile, CrossingSolidsAreRejected) {
  TriMesh s = box_mesh();
  const auto n = static_cast<std::int32_t>(s.x.size());
  const std::vector<Triangle> first = s.triangles;
  for (std::int32_t i = 0; i < n; ++i)
    s.x.push_back(s.x[size_t(i)] + Vec3(3, 2, 1));
  for (const Triangle& t : first)
    s.triangles.push_back({t[0] + n, t[1] + n, t[2] + n});
  expect_rejected(write("two.stl", binary_stl(s)), "crosses or touches itself");
}

// Files that a fuzzer found: CGAL's own error came up, in five lines and without the file's name.
TEST_F(ToolMeshFile, WhatCgalCannotRepairIsRejectedInOneLine) {
  const std::filesystem::path corpus = std::filesystem::path(PLYFORM_TEST_DATA) / "../fuzz/corpus";
  ::testing::internal::CaptureStderr();
  for (const char* file : {"stl/torn.stl", "obj/torn.obj", "off/torn.off", "ply/torn.ply"})
    expect_rejected(corpus / file, "it cannot be made a clean surface");
  expect_rejected(corpus / "obj/not_split.obj", "cannot be split into triangles");
  expect_rejected(corpus / "obj/crossing_face.obj", "a face of 7 corners near "); // SIGSEGV
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

} // namespace
} // namespace plyform::tool_mesh_file_test
