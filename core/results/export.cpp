// SPDX-License-Identifier: GPL-3.0-or-later
// States in formats that other programs read: VTK XML (.vtu), binary STL and CSV.
#include "core/results/export.hpp"

#include "base/format.hpp"
#include "base/outputs.hpp"
#include "base/write_whole.hpp"
#include "core/results/replace_run.hpp"
#include "core/results/result_fields.hpp"

#include <bit>
#include <cstdint>
#include <iterator>
#include <stdexcept>
#include <string_view>
#include <system_error>

namespace plyform {

namespace fs = std::filesystem;

namespace {

// Binary STL is little-endian: numbers are copied from memory.
static_assert(std::endian::native == std::endian::little);

template <class T>
void put_bytes(std::string& out, const T* values, std::size_t count) {
  out.append(reinterpret_cast<const char*>(values), count * sizeof(T));
}

/// Triangles with corners in `x`. Binary STL: 80 bytes of text, the number of triangles, and for
/// each its normal and corners as 12 floats and two empty bytes. Lengths in mm.
std::string stl(const std::vector<Vec3>& x, const std::vector<Triangle>& triangles) {
  std::string out = "plyform, lengths in mm";
  out.resize(80, ' ');
  const auto count = static_cast<std::uint32_t>(triangles.size());
  put_bytes(out, &count, 1);
  for (const Triangle& t : triangles) {
    const Vec3& a = x[t[0]];
    const Vec3& b = x[t[1]];
    const Vec3& c = x[t[2]];
    // the zero vector is returned unchanged
    const Vec3 normal = (b - a).cross(c - a).stableNormalized();
    for (const Vec3& v : {normal, a, b, c}) {
      const Eigen::Vector3f single = v.cast<float>();
      put_bytes(out, single.data(), 3);
    }
    out.append(2, '\0');
  }
  return out;
}

/// Text of a .vtu file under construction. Arrays are written as text, numbers in the shortest form
/// that reads back to the same bits: raw bytes appended after the XML would be shorter, but VTK 9
/// cannot read them with the expat of Debian's security updates (2.5.0-1+deb12u5), which reads
/// further ahead.
struct VtuFile {
  std::string xml;

  template <class T>
  void array(const std::string& name, const char* type, std::size_t components, const T* values,
             std::size_t count) {
    xml += fmt::format("<DataArray Name=\"{}\" type=\"{}\" NumberOfComponents=\"{}\" "
                       "format=\"ascii\">\n",
                       xml_text(name), type, components);
    for (std::size_t i = 0; i < count; ++i)
      fmt::format_to(std::back_inserter(xml), "{}{}", values[i],
                     (i + 1) % components == 0 ? '\n' : ' ');
    xml += "</DataArray>\n";
  }
  void numbers(const std::string& name, const std::vector<double>& values) {
    array(name, "Float64", 1, values.data(), values.size());
  }
  void numbers(const std::string& name, const std::vector<Vec3>& values) {
    array(name, "Float64", 3, values.empty() ? nullptr : values.front().data(), 3 * values.size());
  }
  /// The columns of one place.
  void columns(const PlyFrame& ply, Location place) {
    each_column(ply, [&](const Column& column, const auto& values) {
      if (column.location == place && (!column.may_lack || !values.empty()))
        numbers(column.name, values);
    });
  }
};

void put_cells(VtuFile& file, const std::vector<Triangle>& triangles) {
  const std::size_t m = triangles.size();
  std::vector<std::int32_t> offsets(m);
  for (std::size_t i = 0; i < m; ++i)
    offsets[i] = static_cast<std::int32_t>(3 * (i + 1));
  const std::vector<std::uint8_t> types(m, 5); // VTK_TRIANGLE
  file.xml += "<Cells>\n";
  file.array("connectivity", "Int32", 1, m ? triangles.front().data() : nullptr, 3 * m);
  file.array("offsets", "Int32", 1, offsets.data(), m);
  file.array("types", "UInt8", 1, types.data(), m);
  file.xml += "</Cells>\n";
}

std::string vtu(const PlyFrame& ply) {
  VtuFile file;
  file.xml = "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
             "byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n";
  file.xml += fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n<Points>\n",
                          ply.x.size(), ply.triangles.size());
  file.numbers("Points", ply.x);
  file.xml += "</Points>\n";
  put_cells(file, ply.triangles);
  file.xml += "<PointData>\n";
  file.numbers("x0", ply.x0);
  file.columns(ply, Location::node);
  file.xml += "</PointData>\n<CellData>\n";
  file.columns(ply, Location::triangle);
  return file.xml + "</CellData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
}

/// Writes one state; `suffix` follows the names of bodies. `kept`: files that it must not replace.
void export_state(const Frame& state, const ExportChoice& choice, const fs::path& folder,
                  const std::vector<fs::path>& kept, const std::string& suffix,
                  std::vector<fs::path>& files) {
  const auto write = [&](const std::string& name, const char* ending, const std::string& content) {
    files.push_back(folder / (name + suffix + ending));
    keep_files(files.back(), kept);
    keep_foreign(files.back(), std::string_view(content).substr(0, 16)); // of its own kind
    write_whole(files.back(), content);
  };
  for (const PlyFrame& ply : state.plies) {
    if (choice.vtu) write(ply.name, ".vtu", vtu(ply));
    if (choice.stl) write(ply.name, ".stl", stl(ply.x, ply.triangles));
    if (choice.csv) write(ply.name, ".csv", ply_table(ply));
  }
  if (!choice.stl) return;
  for (const ToolFrame& tool : state.tools) {
    std::vector<Vec3> x = tool.surface.x;
    for (Vec3& point : x)
      point += tool.displacement;
    write(tool.name, ".stl", stl(x, tool.surface.triangles));
  }
}

} // namespace

std::vector<fs::path> export_results(const fs::path& directory, const ExportChoice& choice) {
  const fs::path states = directory / "results.h5";
  const bool numbered = choice.all || choice.frame;
  const long count = numbered ? count_frames(states) : 0;
  const long one = choice.frame.value_or(-1);
  // what is not there is told by read_frame
  const long first = choice.all ? 0 : one < 0 ? count + one : one;
  const long end = choice.all ? count : first + 1;
  if (choice.frame && one < -1)
    throw std::runtime_error(fmt::format("there is no frame {}: states are numbered from 0, and -1 "
                                         "is the last",
                                         one));
  const fs::path folder = choice.folder.empty() ? directory / "export" : choice.folder;
  std::vector<fs::path> kept = files_of_run(directory);
  for (fs::path& file : kept)
    file = directory / file;
  std::vector<fs::path> files;
  for (long index = first; index < end; ++index) {
    if (choice.progress)
      choice.progress(static_cast<double>(index - first) / static_cast<double>(end - first));
    const Frame state =
        numbered ? read_frame(states, index < 0 ? one : index) : read_last_frame(states);
    std::error_code error;
    fs::create_directories(folder, error);
    if (error)
      throw std::runtime_error(
          fmt::format("{}: cannot create the folder: {}", folder.string(), error.message()));
    export_state(state, choice, folder, kept, numbered ? fmt::format("_{:06}", index) : "", files);
  }
  return files;
}

} // namespace plyform
