// SPDX-License-Identifier: GPL-3.0-or-later
// results.xdmf: describes the datasets of results.h5 for ParaView. Version 2 of the format, which
// the readers of XDMF 2 and of XDMF 3 both read, except for the functions that move tools: the XDMF
// 3 reader of VTK leaves such geometries empty. The file has one time series for each ply and each
// tool in one collection. With one collection per time instead, the XDMF 2 reader would name the
// blocks NAME, NAME[1], NAME[2] at successive times.
#include "base/format.hpp"
#include "core/results/result_fields.hpp"

#include <cmath>

namespace plyform {

std::string xml_text(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '\'')
      out += "&apos;";
    else
      out += c; // < > " and control characters do not pass check_frame
  }
  return out;
}

namespace {

std::string data_item(std::size_t rows, std::size_t columns, const char* type, int bytes,
                      const std::string& dataset) {
  const std::string size =
      columns == 1 ? fmt::to_string(rows) : fmt::format("{} {}", rows, columns);
  return fmt::format("<DataItem Dimensions=\"{}\" NumberType=\"{}\" Precision=\"{}\" "
                     "Format=\"HDF\">results.h5:{}</DataItem>\n",
                     size, type, bytes, xml_text(dataset));
}

std::string attribute(const std::string& name, const char* type, const char* centre,
                      const std::string& item) {
  return fmt::format("<Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"{}\">{}</Attribute>\n",
                     xml_text(name), type, centre, item);
}

/// Topology element of m triangles in a dataset.
std::string topology(std::size_t m, const std::string& triangles) {
  return fmt::format("<Topology TopologyType=\"Triangle\" NumberOfElements=\"{}\">{}</Topology>\n",
                     m, data_item(m, 3, "Int", 4, triangles));
}

/// Geometry element of n points in a dataset.
std::string geometry(std::size_t n, const std::string& x) {
  return fmt::format("<Geometry GeometryType=\"XYZ\">{}</Geometry>\n",
                     data_item(n, 3, "Float", 8, x));
}

/// Geometry element of points that are displaced by a vector: each coordinate is the sum of a
/// column of the dataset and a constant.
std::string moved_geometry(std::size_t n, const std::string& x, const Vec3& by) {
  std::string columns;
  for (int k = 0; k < 3; ++k)
    columns += fmt::format(
        "<DataItem ItemType=\"Function\" Function=\"$0 {} {:.12f}\" Dimensions=\"{} 1\" "
        "NumberType=\"Float\" Precision=\"8\">\n"
        "<DataItem ItemType=\"HyperSlab\" Type=\"HyperSlab\" Dimensions=\"{} 1\" "
        "NumberType=\"Float\" Precision=\"8\">\n"
        "<DataItem Dimensions=\"3 2\" NumberType=\"Int\" Format=\"XML\">0 {} 1 1 {} 1</DataItem>\n"
        "{}</DataItem>\n</DataItem>\n",
        by[k] < 0.0 ? '-' : '+', std::abs(by[k]), n, n, k, n, data_item(n, 3, "Float", 8, x));
  return fmt::format("<Geometry GeometryType=\"X_Y_Z\">\n{}</Geometry>\n", columns);
}

std::string grid_start(const std::string& name, double time) {
  return fmt::format("<Grid Name=\"{}\" GridType=\"Uniform\">\n<Time Value=\"{:.9g}\"/>\n",
                     xml_text(name), time);
}

std::string ply_grid(const PlyFrame& ply, const std::string& group, double time) {
  const std::size_t n = ply.x.size(), m = ply.triangles.size();
  const std::string here = group + "/plies/" + ply.name + "/";
  std::string out = grid_start(ply.name, time) + topology(m, "/plies/" + ply.name + "/triangles") +
                    geometry(n, here + "x");
  each_column(ply, [&]<class Value>(const Column& column, const std::vector<Value>& values) {
    if (column.may_lack && values.empty()) return;
    const bool vector = std::is_same_v<Value, Vec3>, nodes = column.location == Location::node;
    out += attribute(column.name, vector ? "Vector" : "Scalar", nodes ? "Node" : "Cell",
                     data_item(nodes ? n : m, vector ? 3 : 1, "Float", 8, here + column.name));
  });
  return out + "</Grid>\n";
}

/// Grid of a tool. results.h5 contains its surface once, in the initial position.
std::string tool_grid(const ToolFrame& tool, double time) {
  const std::string fixed = "/tools/" + tool.name + "/", x0 = fixed + "x0";
  const std::size_t n = tool.surface.x.size();
  return grid_start(tool.name, time) +
         topology(tool.surface.triangles.size(), fixed + "triangles") +
         (tool.displacement.isZero(0) ? geometry(n, x0)
                                      : moved_geometry(n, x0, tool.displacement)) +
         "</Grid>\n";
}

} // namespace

std::string frame_group(std::size_t index) {
  return fmt::format("/frames/{:06}", index);
}

void XdmfText::add(const Frame& frame, std::size_t index) {
  const std::string group = frame_group(index);
  if (names.empty()) {
    for (const PlyFrame& ply : frame.plies)
      names.push_back(ply.name);
    for (const ToolFrame& tool : frame.tools)
      names.push_back(tool.name);
    grids.resize(names.size());
  }
  std::size_t part = 0;
  for (const PlyFrame& ply : frame.plies)
    grids[part++] += ply_grid(ply, group, frame.time);
  for (const ToolFrame& tool : frame.tools)
    grids[part++] += tool_grid(tool, frame.time);
}

std::string XdmfText::document() const {
  std::string out = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<Xdmf Version=\"2.0\">\n<Domain>\n"
                    "<Grid Name=\"plyform\" GridType=\"Collection\" CollectionType=\"Spatial\">\n";
  for (std::size_t i = 0; i < names.size(); ++i)
    out += fmt::format(
        "<Grid Name=\"{}\" GridType=\"Collection\" CollectionType=\"Temporal\">\n{}</Grid>\n",
        xml_text(names[i]), grids[i]);
  return out + "</Grid>\n</Domain>\n</Xdmf>\n";
}

} // namespace plyform
