// SPDX-License-Identifier: GPL-3.0-or-later
// What the readers of mesh formats accept, and files that go against their format.
#include "base/polygon_file.hpp"

#include <cstring>
#include <gtest/gtest.h>

namespace plyform::polygon_file_test {
namespace {

/// The message about a file's content; empty if it is accepted.
std::string refusal(const std::string& extension, const std::string& bytes) {
  try {
    parse_polygons(extension, bytes);
    return "";
  } catch (const std::runtime_error& error) {
    return error.what();
  }
}

void expect_refused(const std::string& extension, const std::string& bytes,
                    const std::string& fragment) {
  const std::string message = refusal(extension, bytes);
  EXPECT_NE(message.find(fragment), std::string::npos) << bytes << "\n-> " << message;
  EXPECT_NE(message.find("; "), std::string::npos) << "no remedy: " << message;
}

const std::string ply_start = "ply\nformat ascii 1.0\n";
const std::string ply_points = "element vertex 3\nproperty float x\nproperty float y\n"
                               "property float z\n";
const std::string ply_faces = "element face 1\nproperty list uchar int vertex_indices\n";
const std::string three = "0 0 0\n1 0 0\n0 1 0\n";

TEST(PolygonFile, PlyHeadersThatGoAgainstTheFormatAreRefused) {
  expect_refused(".ply", ply_start + "property float x\n" + ply_points + ply_faces + "end_header\n",
                 "line 3: the header has a property before any element");
  expect_refused(".ply", ply_start + ply_points + "property half q\nend_header\n" + three,
                 "line 7: the header has a property of type 'half'");
  expect_refused(".ply", ply_start + "element vertex 999999999999\n",
                 "line 3: the count of an element is 999999999999, more than");
  expect_refused(".ply", ply_start + "element vertex -3\n", "the count of an element is -3");
  expect_refused(".ply", ply_start + "element vertex\n", "the count of an element is missing");
  expect_refused(".ply", "ply\nelement vertex 3\nend_header\n0\n0\n0\n", "names no format");
  expect_refused(".ply", "ply\nformat middle_endian 1.0\nend_header\n", "'middle_endian'");
  expect_refused(".ply", ply_start + "element vertex 1\nproperty float x\nend_header\n0\n",
                 "no single number y");
  expect_refused(".ply", ply_start + ply_points + "property list float int a\nend_header\n",
                 "a length that is no whole number");
  expect_refused(".ply", ply_start + ply_points + "property list\nend_header\n", "of type ''");
  expect_refused(".ply", ply_start + ply_points + "end of it\n",
                 "'end' is no line of a PLY header");
  expect_refused(".ply",
                 ply_start + ply_points + "element face 1\nproperty int corners\nend_header\n" +
                     three + "0\n",
                 "no list vertex_indices");
}

TEST(PolygonFile, PlyBodiesThatGoAgainstTheirHeaderAreRefused) {
  const std::string header = ply_start + ply_points + ply_faces + "end_header\n";
  EXPECT_EQ(refusal(".ply", header + three + "3 0 1 2\n"), "");
  expect_refused(".ply", header + three + "3 0 1 3\n",
                 "face 0 names point 3, but there are only 3");
  expect_refused(".ply", header + three + "3 0 1 -1\n", "face 0 names point -1");
  expect_refused(".ply", header + three + "9999 0 1 2\n", "a list has 9999 entries");
  expect_refused(".ply", header + three + "-1 0 1 2\n", "a list has -1 entries");
  expect_refused(".ply", header + three + "3 0 1 2\n3 0 1 2\n", "line 5: '3' stands after");
  expect_refused(".ply", header + three, "is missing");
  expect_refused(".ply", header + "0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n",
                 "line 2: a coordinate is not a finite number");
}

TEST(PolygonFile, PlyMayHaveFurtherPropertiesAndElements) {
  const PolygonSoup soup = parse_polygons(
      ".ply", ply_start +
                  "comment made by hand\nelement camera 2\nproperty float a\n"
                  "element nothing 7\n" +
                  ply_points +
                  "property list uchar float weights\nproperty uchar red\nelement face 2\n"
                  "property uchar flag\nproperty list uint8 uint32 vertex_index\n"
                  "end_header\n1.5 nan\n0 0 0 2 7 8 9\n1 0 0 0 9\n0 1 0 1 nan 9\n0 3 0 1 2\n1 4 0 "
                  "1 2 1\n");
  ASSERT_EQ(soup.points.size(), 3u);
  EXPECT_EQ(soup.points[1], Vec3(1, 0, 0));
  ASSERT_EQ(soup.polygons.size(), 2u);
  EXPECT_EQ(soup.polygons[0], (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_EQ(soup.polygons[1].size(), 4u);
}

TEST(PolygonFile, PlyIsReadInEitherOrderOfBytes) {
  const auto file = [](bool big) {
    std::string bytes = std::string("ply\nformat binary_") + (big ? "big" : "little") +
                        "_endian 1.0\nelement vertex 3\nproperty double x\nproperty float y\n"
                        "property short z\nelement face 1\n"
                        "property list uint16 int8 vertex_indices\nend_header\n";
    const auto put = [&](auto value) {
      std::string part(sizeof value, ' ');
      std::memcpy(part.data(), &value, sizeof value);
      bytes += big ? std::string(part.rbegin(), part.rend()) : part;
    };
    for (int i = 0; i < 3; ++i)
      put(0.1 * i), put(0.5f), put(static_cast<std::int16_t>(-7 * i));
    put(static_cast<std::uint16_t>(3));
    for (const int i : {2, 0, 1})
      put(static_cast<std::int8_t>(i));
    return bytes;
  };
  for (const bool big : {false, true}) {
    const std::string bytes = file(big);
    const PolygonSoup soup = parse_polygons(".ply", bytes);
    ASSERT_EQ(soup.points.size(), 3u);
    EXPECT_EQ(soup.points[2], Vec3(0.1 * 2, 0.5, -14));
    EXPECT_EQ(soup.polygons, (std::vector<std::vector<std::size_t>>{{2, 0, 1}}));
    expect_refused(".ply", bytes + "more", "goes on after the elements");
    for (std::size_t size = 0; size < bytes.size(); ++size)
      EXPECT_NE(refusal(".ply", bytes.substr(0, size)), "") << size;
  }
}

TEST(PolygonFile, StlThatGoesAgainstItsFormatIsRefused) {
  const std::string facet = "facet normal nan 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
                            "vertex 0 1 0\nendloop\nendfacet\n";
  const std::string solid = "solid a facet\n" + facet + "endsolid a\n";
  EXPECT_EQ(parse_polygons(".stl", solid + solid).polygons.size(), 2u);
  EXPECT_EQ(parse_polygons(".stl", "  SOLID\n" + facet + "ENDSOLID\n").polygons.size(), 1u);
  expect_refused(".stl", "solid a\n" + facet + "facet\nendsolid a\n",
                 "line 10: 'endsolid' stands where an STL has normal");
  expect_refused(".stl", "solid a\n" + facet, "no endsolid after 1 facets");
  expect_refused(".stl", solid + "more", "line 10: 'more' stands where an STL has solid");
  expect_refused(".stl", "solid a\nfacet normal 0 0\nouter loop\nendsolid", "no three numbers");
  std::string binary(84 + 2 * 50, '\0');
  binary[80] = 1;
  expect_refused(".stl", binary, "promises 1 facets, but it holds 2");
  binary[80] = 3;
  expect_refused(".stl", binary, "promises 3 facets, it holds 2");
  binary[80] = 2;
  EXPECT_EQ(refusal(".stl", binary), "");
}

TEST(PolygonFile, StlIsBinaryOrTextByItsSizeNotItsTitle) {
  // A title that looks like a text's, and bytes behind the last facet, as some exporters leave.
  for (const std::string title : {"solid facet normal", "SOLID\nfacet\nendsolid", "endsolid", ""})
    for (const std::size_t more : {0, 2, 49}) {
      std::string binary = title + std::string(84 + 2 * 50 + more - title.size(), '\0');
      binary[80] = 2;
      const float corner = 1.5F;
      std::memcpy(&binary[84 + 50 + 12], &corner, sizeof corner);
      const PolygonSoup soup = parse_polygons(".stl", binary);
      EXPECT_EQ(soup.polygons.size(), 2u) << title << more;
      EXPECT_EQ(soup.points[3], Vec3(1.5, 0, 0));
      expect_refused(".stl", binary.substr(0, 84 + 60), "truncated: its header promises 2 facets");
    }
  expect_refused(".stl", "solid " + std::string("\x1b[2J\xff") + "\n\x1b]0;x\xff\n",
                 "the file is truncated: 19 bytes");
  expect_refused(".stl", "solid a\n\xff\xc2\x9b\n", "line 2: '\\xff\\u{9b}' stands where");
}

TEST(PolygonFile, NumbersTooSmallForADoubleAreZero) {
  const std::string facet = "facet normal 0 0 1\nouter loop\nvertex 1.5e-400 0 0\nvertex 1 0 0\n"
                            "vertex 0 1 0\nendloop\nendfacet\n";
  EXPECT_EQ(parse_polygons(".stl", "solid a\n" + facet + "endsolid a\n").points[0], Vec3::Zero());
}

TEST(PolygonFile, OffThatGoesAgainstItsFormatIsRefused) {
  const std::string header = "OFF # a comment\n# another\n3 1 0\n";
  EXPECT_EQ(refusal(".off", header + three + "3 0 1 2 255 0 0\n\n# end\n"), "");
  EXPECT_EQ(parse_polygons(".off", "COFF\n3 1\n0 0 0 1 1 1\n1 0 0 1 1 1\n0 1 0 1 1 1\n3 0 1 2")
                .polygons.size(),
            1u);
  expect_refused(".off", header + three + "3 0 1 3\n", "line 7: a face names point 3");
  expect_refused(".off", header + three + "3 0 1\n", "the number of a point is missing");
  expect_refused(".off", header + three + "3 0 1 2\n3 0 1 2\n", "line 8: '3' stands after the 1");
  expect_refused(".off", header + "0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
                 "line 4: a coordinate is missing");
  expect_refused(".off", "OFF\n99999999999 1 0\n", "line 2: the number of points is 99999999999");
  expect_refused(".off", "OFF BINARY\n", "binary OFF");
  expect_refused(".off", "4OFF\n", "begins with '4OFF'");
}

TEST(PolygonFile, ObjThatGoesAgainstItsFormatIsRefused) {
  const std::string points = "v 0 0 0 1.0\nv 1 0 0\nv 0 1 0\n";
  const PolygonSoup soup =
      parse_polygons(".obj", "mtllib a.mtl\no a\n" + points +
                                 "vt 0 0\nvn 0 0 1\ns off\nf 1/1/1 2//1 \\\n 3/1\n"
                                 "f -3 -2 -1\n");
  EXPECT_EQ(soup.polygons, (std::vector<std::vector<std::size_t>>{{0, 1, 2}, {0, 1, 2}}));
  expect_refused(".obj", points + "f 1 2 4\n", "names point 4, but there are only 3");
  expect_refused(".obj", points + "f 0 1 2\n", "line 4: a face names point 0");
  expect_refused(".obj", points + "f -4 1 2\n", "line 4: a face names point -4");
  expect_refused(".obj", points + "f 1 2\n", "line 4: a face has less than three corners");
  expect_refused(".obj", points + "f 1 2 x\n", "is 'x', not a whole number");
  expect_refused(".obj", points + "curv 0 1 1 2\nf 1 2 3\n", "'curv' is nothing that can be read");
  expect_refused(".obj", "v 0 0\n" + points + "f 1 2 3\n", "line 1: a coordinate is missing");
}

} // namespace
} // namespace plyform::polygon_file_test
