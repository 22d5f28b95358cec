// SPDX-License-Identifier: GPL-3.0-or-later
// Mesh files by format: STL, OBJ, OFF; PLY is in polygon_ply.cpp.
#include "base/polygon_file.hpp"

#include "base/polygon_text.hpp"
#include "base/read_file.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace plyform {
namespace {

[[noreturn]] void refuse(const std::string& text) {
  throw std::runtime_error(text);
}

// ---- STL ----

/// Reads `word`, in any case. Throws if another stands there.
void expect_word(WordReader& in, const char* word, std::size_t facets) {
  const std::string_view found = in.word();
  if (found.empty())
    refuse(fmt::format("the file is truncated: no endsolid after {} facets; export or copy it "
                       "again",
                       facets));
  if (lower_case(found) != word)
    in.fail(fmt::format("'{}' stands where an STL has {}; export the mesh again", shown(found, 30),
                        word));
}

/// Reads the rest of a facet. Its normal is not used, and some exporters write nan there.
void ascii_facet(WordReader& in, PolygonSoup& soup) {
  const std::size_t facets = soup.polygons.size();
  expect_word(in, "normal", facets);
  for (int k = 0; k < 3; ++k)
    if (in.word_of_line().empty()) in.fail("the normal has no three numbers; export it again");
  expect_word(in, "outer", facets);
  expect_word(in, "loop", facets);
  for (int corner = 0; corner < 3; ++corner) {
    expect_word(in, "vertex", facets);
    Vec3 p;
    for (int k = 0; k < 3; ++k)
      p[k] = in.coordinate(in.word());
    soup.points.push_back(p);
  }
  expect_word(in, "endloop", facets);
  expect_word(in, "endfacet", facets);
  soup.polygons.push_back({3 * facets, 3 * facets + 1, 3 * facets + 2});
}

/// One or more solids, one after the other.
PolygonSoup parse_ascii_stl(std::string_view text) {
  PolygonSoup soup;
  WordReader in(text);
  bool open = false;
  for (;;) {
    const std::string_view found = in.word();
    const std::string word = lower_case(found);
    if (found.empty() && !open) return soup;
    if (word == (open ? "endsolid" : "solid")) {
      open = !open;
      in.skip_line(); // its name
    } else if (open && word == "facet") {
      ascii_facet(in, soup);
    } else if (open && found.empty()) {
      expect_word(in, "endsolid", soup.polygons.size());
    } else {
      in.fail(fmt::format("'{}' stands where an STL has {}; export the mesh again",
                          shown(found, 30), open ? "facet or endsolid" : "solid"));
    }
  }
}

constexpr std::size_t stl_header = 84, stl_facet = 50; // bytes: title and count; one facet

std::size_t facets_promised(std::string_view bytes) {
  std::uint32_t count = 0;
  if (bytes.size() >= stl_header) std::memcpy(&count, bytes.data() + 80, sizeof count);
  return count;
}

PolygonSoup parse_binary_stl(std::string_view bytes) {
  if (bytes.size() < stl_header)
    refuse(fmt::format("the file is truncated: {} bytes are less than the header of a binary STL; "
                       "export or copy it again",
                       bytes.size()));
  const std::size_t count = facets_promised(bytes), held = (bytes.size() - stl_header) / stl_facet;
  if (held < count)
    refuse(fmt::format("the file is truncated: its header promises {} facets, it holds {}; export "
                       "or copy it again",
                       count, held));
  if (held > count)
    refuse(fmt::format("its header promises {} facets, but it holds {}: {} bytes follow them; "
                       "export or copy it again",
                       count, held, bytes.size() - stl_header - count * stl_facet));
  PolygonSoup soup;
  for (std::size_t f = 0; f < count; ++f) {
    std::array<float, 9> corners{};
    std::memcpy(corners.data(), bytes.data() + stl_header + f * stl_facet + 12, sizeof corners);
    for (std::size_t k = 0; k < 9; k += 3) {
      soup.points.emplace_back(corners[k], corners[k + 1], corners[k + 2]);
      if (!soup.points.back().allFinite()) refuse(fmt::format("facet {}: {}", f, not_finite));
    }
    soup.polygons.push_back({3 * f, 3 * f + 1, 3 * f + 2});
  }
  return soup;
}

// ---- OBJ ----

/// The number of a point that a corner 7, 7/2, 7//3 or -1 names.
std::size_t obj_point(const WordReader& in, std::string_view corner, std::size_t points) {
  const std::int64_t number =
      in.integer(corner.substr(0, corner.find('/')), "the number of a point");
  const auto most = static_cast<std::int64_t>(points);
  if (number == 0 || number < -most)
    in.fail(fmt::format("a face names point {}, but there are {} before it, from 1; export the "
                        "mesh again",
                        number, points));
  return static_cast<std::size_t>(number > 0 ? number - 1 : most + number);
}

bool means_no_surface(std::string_view word) {
  constexpr std::array<std::string_view, 22> known{
      "vt",  "vn",       "vp",       "g",          "o",         "s",    "mg",     "usemtl",
      "l",   "mtllib",   "p",        "usemap",     "lod",       "call", "maplib", "bevel",
      "csh", "c_interp", "d_interp", "shadow_obj", "trace_obj", "vc"};
  return std::find(known.begin(), known.end(), word) != known.end();
}

// ---- OFF ----

/// The words in front of the counts; the first may be OFF or have letters for what stands beside
/// the coordinates of a point, which is not read.
void off_header(WordReader& in) {
  const std::string_view word = in.word();
  if (word == "OFF" || word == "COFF" || word == "NOFF" || word == "CNOFF" || word == "STOFF" ||
      word == "STCOFF" || word == "STNOFF" || word == "STCNOFF")
    return;
  in.fail(fmt::format("no faces could be read as off: it begins with '{}', not with OFF; export "
                      "the surface again, as three-dimensional text",
                      shown(word, 30)));
}

} // namespace

PolygonSoup parse_stl(std::string_view bytes) {
  // The size decides, whatever the title says; less than a facet may follow the last one.
  if (bytes.size() >= stl_header &&
      (bytes.size() - stl_header) / stl_facet == facets_promised(bytes))
    return parse_binary_stl(bytes);
  // Else a text: the count of a binary one has a byte 0 up to 16 million facets.
  const std::string_view start = bytes.substr(0, 4096);
  const std::size_t first = start.find_first_not_of(" \t\r\n");
  const bool solid =
      first != std::string_view::npos && lower_case(start.substr(first, 5)) == "solid";
  const bool text = std::none_of(start.begin(), start.end(), [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return (byte < ' ' && (byte < '\t' || byte > '\r')) || byte == 0x7F;
  });
  return solid && text ? parse_ascii_stl(bytes) : parse_binary_stl(bytes);
}

PolygonSoup parse_obj(std::string_view bytes) {
  std::string text(bytes); // a backslash at the end of a line goes on in the next
  for (std::size_t at = text.find('\\'); at != std::string::npos; at = text.find('\\', at + 1)) {
    const std::size_t end = text.find_first_not_of(" \t\r", at + 1);
    if (end != std::string::npos && text[end] == '\n') text[at] = text[end] = ' ';
  }
  PolygonSoup soup;
  WordReader in(text, '#');
  std::size_t most = 0; // the largest number of a point, from 1
  for (std::string_view word = in.word(); !word.empty(); word = in.word()) {
    if (word == "v") {
      Vec3 p;
      for (int k = 0; k < 3; ++k)
        p[k] = in.coordinate(in.word_of_line());
      soup.points.push_back(p);
    } else if (word == "f" || word == "fo") {
      std::vector<std::size_t>& polygon = soup.polygons.emplace_back();
      for (auto corner = in.word_of_line(); !corner.empty(); corner = in.word_of_line()) {
        polygon.push_back(obj_point(in, corner, soup.points.size()));
        most = std::max(most, polygon.back() + 1);
      }
      if (polygon.size() < 3) in.fail("a face has less than three corners; export the mesh again");
    } else if (!means_no_surface(word)) {
      in.fail(fmt::format("'{}' is nothing that can be read as obj: only points and faces can; "
                          "export the surface as triangles",
                          shown(word, 30)));
    }
    in.skip_line();
  }
  if (most > soup.points.size())
    refuse(fmt::format("a face names point {}, but there are only {}; export the mesh again", most,
                       soup.points.size()));
  if (soup.polygons.empty())
    refuse("no faces could be read as obj: it is truncated, or holds other things than a surface; "
           "export the surface again");
  return soup;
}

PolygonSoup parse_off(std::string_view bytes) {
  WordReader in(bytes, '#');
  off_header(in);
  std::string_view word = in.word();
  if (word == "BINARY") in.fail("it is a binary OFF; export it as text, or as STL");
  const std::size_t points = in.count(word, "the number of points");
  const std::size_t faces = in.count(in.word(), "the number of faces");
  in.skip_line(); // the number of edges, which may be missing
  PolygonSoup soup;
  for (std::size_t i = 0; i < points; ++i) {
    Vec3 p;
    p[0] = in.coordinate(in.word());
    for (int k = 1; k < 3; ++k)
      p[k] = in.coordinate(in.word_of_line());
    soup.points.push_back(p);
    in.skip_line(); // normals and colours
  }
  for (std::size_t f = 0; f < faces; ++f) {
    const std::size_t corners = in.count(in.word(), "the number of a face's corners");
    std::vector<std::size_t>& polygon = soup.polygons.emplace_back();
    for (std::size_t k = 0; k < corners; ++k)
      polygon.push_back(in.point_number(in.word_of_line(), points));
    in.skip_line(); // colours
  }
  in.expect_end(fmt::format("the {} faces that its header counts", faces));
  return soup;
}

PolygonSoup parse_polygons(const std::string& extension, std::string_view bytes) {
  if (extension == ".stl") return parse_stl(bytes);
  if (extension == ".obj") return parse_obj(bytes);
  if (extension == ".ply") return parse_ply(bytes);
  return parse_off(bytes);
}

PolygonSoup read_polygons(const std::filesystem::path& file) {
  const std::string extension = lower_case(file.extension().string());
  if (extension != ".stl" && extension != ".obj" && extension != ".ply" && extension != ".off") {
    const bool solid =
        extension == ".step" || extension == ".stp" || extension == ".iges" || extension == ".igs";
    refuse(fmt::format("the extension '{}' is none of .stl, .obj, .ply and .off; {}",
                       shown(extension, 30),
                       solid ? "mesh_tool.py PART.step -o PART.stl makes the mesh of a solid"
                             : "export the mesh in one of these formats"));
  }
  if (!std::filesystem::exists(file)) refuse("there is no such file; check the path");
  std::string reason;
  const std::optional<std::string> bytes = read_file(file, most_mesh_bytes, reason);
  if (!bytes) refuse(reason + "; check the path and the file");
  if (bytes->empty()) refuse("the file is empty; export or copy it again");
  return parse_polygons(extension, *bytes);
}

} // namespace plyform
