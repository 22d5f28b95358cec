// SPDX-License-Identifier: GPL-3.0-or-later
// Reads tool meshes. CGAL's readers report success for some broken files (a truncated STL gives no
// faces, or the first few), so the number of faces read is compared with that which an STL
// declares.
#include "contact/shapes/tool_mesh.hpp"

#include <CGAL/IO/OBJ.h>
#include <CGAL/IO/OFF.h>
#include <CGAL/IO/PLY.h>
#include <CGAL/IO/STL.h>
#include <CGAL/Simple_cartesian.h>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

namespace plyform {
namespace {

using Point = CGAL::Simple_cartesian<double>::Point_3;

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& text) {
  throw std::runtime_error(fmt::format("tool mesh {}: {}", file.string(), text));
}

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

std::string contents(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) fail(file, "cannot be opened; check the permissions");
  return {std::istreambuf_iterator<char>(in), {}};
}

bool is_non_finite_word(std::string word) {
  word = lower(std::move(word));
  if (!word.empty() && (word[0] == '-' || word[0] == '+')) word.erase(0, 1);
  return word.starts_with("nan") || word == "inf" || word == "infinity";
}

/// What a scan of an ASCII STL finds. Facet normals are ignored: they are not used, and some
/// exporters write nan there.
struct AsciiStl {
  std::size_t facets = 0;
  bool ended = false, non_finite = false;
};

AsciiStl scan_ascii_stl(const std::string& text) {
  AsciiStl found;
  std::istringstream in(text);
  for (std::string word; in >> word;) {
    if (word == "facet") ++found.facets;
    if (word == "endsolid") found.ended = true;
    if (word != "vertex") continue;
    for (int k = 0; k < 3 && in >> word; ++k)
      found.non_finite = found.non_finite || is_non_finite_word(word);
  }
  return found;
}

constexpr const char* non_finite =
    "a coordinate is not a finite number (nan or inf); export the mesh again";

/// Number of facets that an STL declares. Throws std::runtime_error if it does not hold that many.
std::size_t check_stl(const std::filesystem::path& file, const std::string& bytes) {
  constexpr std::size_t header = 84, record = 50; // bytes: title and count; one facet
  std::uint32_t count = 0;
  if (bytes.size() >= header) std::memcpy(&count, bytes.data() + 80, sizeof count);
  const bool exactly_binary = bytes.size() == header + record * count;
  const bool ascii = bytes.starts_with("solid") && bytes.find("facet") != std::string::npos;
  if (ascii && !exactly_binary) {
    const AsciiStl found = scan_ascii_stl(bytes);
    if (found.non_finite) fail(file, non_finite);
    if (!found.ended)
      fail(file, fmt::format("the file is truncated: no endsolid after {} facets; export or copy "
                             "it again",
                             found.facets));
    return found.facets;
  }
  if (bytes.starts_with("solid") && bytes.find("endsolid") != std::string::npos) return 0;
  if (bytes.size() < header)
    fail(file, fmt::format("the file is truncated: {} bytes are less than the header of a binary "
                           "STL; export or copy it again",
                           bytes.size()));
  if (bytes.size() < header + record * count)
    fail(file, fmt::format("the file is truncated: its header promises {} facets, it holds {}; "
                           "export or copy it again",
                           count, (bytes.size() - header) / record));
  return count;
}

/// Whether a text file holds a word that reads as nan or inf. Used for the error message only.
bool has_non_finite_word(const std::string& text) {
  std::istringstream in(text);
  for (std::string word; in >> word;)
    if (is_non_finite_word(word)) return true;
  return false;
}

bool read_as(const std::string& extension, const std::string& name, std::vector<Point>& points,
             std::vector<std::vector<std::size_t>>& polygons) {
  const auto quiet = CGAL::parameters::verbose(false); // errors are reported once, by the caller
  if (extension == ".stl") return CGAL::IO::read_STL(name, points, polygons, quiet);
  if (extension == ".obj") return CGAL::IO::read_OBJ(name, points, polygons, quiet);
  if (extension == ".ply") return CGAL::IO::read_PLY(name, points, polygons, quiet);
  return CGAL::IO::read_OFF(name, points, polygons, quiet);
}

} // namespace

PolygonSoup read_polygons(const std::filesystem::path& file) {
  const std::string extension = lower(file.extension().string());
  if (extension != ".stl" && extension != ".obj" && extension != ".ply" && extension != ".off")
    fail(file, fmt::format("the extension '{}' is none of .stl, .obj, .ply and .off; export the "
                           "mesh in one of these formats",
                           extension));
  if (!std::filesystem::exists(file)) fail(file, "there is no such file; check the path");
  if (!std::filesystem::is_regular_file(file)) fail(file, "this is not a file; check the path");
  const std::string bytes = contents(file);
  if (bytes.empty()) fail(file, "the file is empty; export or copy it again");
  const std::size_t promised = extension == ".stl" ? check_stl(file, bytes) : 0;

  std::vector<Point> points;
  PolygonSoup soup;
  bool read = false;
  try {
    read = read_as(extension, file.string(), points, soup.polygons);
  } catch (const std::exception&) {
    read = false; // reported below, with the file's name
  }
  const bool partial = extension == ".stl" && soup.polygons.size() != promised;
  if (!read || partial) {
    if (extension != ".stl" && has_non_finite_word(bytes)) fail(file, non_finite);
    const std::size_t faces = soup.polygons.size();
    fail(file, fmt::format("{} could be read as {}: it is truncated, a number is malformed, or it "
                           "holds other things than a surface; export the surface again",
                           faces == 0 ? "no faces" : fmt::format("only {} faces", faces),
                           extension.substr(1)));
  }
  soup.points.reserve(points.size());
  for (const Point& p : points)
    soup.points.emplace_back(p.x(), p.y(), p.z());
  return soup;
}

MeshShapePtr load_tool_mesh(const std::filesystem::path& file, double scale, MeshReport* report) {
  if (!(scale > 0.0) || !std::isfinite(scale))
    fail(file, fmt::format("scale = {:g} must be a finite number above 0; 1000 turns metres into "
                           "millimetres",
                           scale));
  PolygonSoup soup = read_polygons(file);
  for (Vec3& p : soup.points)
    p *= scale;
  return make_mesh_shape(std::move(soup), fmt::format("tool mesh {}", file.string()), report);
}

} // namespace plyform
