// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/model/ply_frame.hpp"

#include <set>
#include <type_traits>

namespace plyform {

std::vector<Column> columns_of(const PlyFrame& ply) {
  std::vector<Column> found;
  each_column(ply, [&](Column column, const auto& values) {
    if (!column.may_lack || !values.empty()) found.push_back(std::move(column));
  });
  return found;
}

const std::vector<double>* triangle_values(const PlyFrame& ply, const std::string& name) {
  const std::vector<double>* found = nullptr;
  each_column(ply, [&]<class Value>(const Column& column, const std::vector<Value>& values) {
    if constexpr (std::is_same_v<Value, double>)
      if (column.location == Location::triangle && column.name == name &&
          !(column.may_lack && values.empty()))
        found = &values;
  });
  return found;
}

std::string name_used_twice(const PlyFrame& ply) {
  // what else stands beside the columns: in tables, in results.h5, and as attributes in Python
  std::set<std::string> names{"x0", "y0", "z0", "x", "y", "z", "triangles", "name"};
  std::string twice;
  const auto take = [&](const std::string& name) {
    if (!names.insert(name).second && twice.empty()) twice = name;
  };
  each_column(ply, [&]<class Value>(const Column& column, const std::vector<Value>&) {
    take(column.name);
    if constexpr (std::is_same_v<Value, Vec3>)
      for (const char* axis : {"_x", "_y", "_z"})
        take(column.name + axis);
  });
  return twice;
}

std::vector<double> areas_before(const PlyFrame& ply) {
  std::vector<double> areas;
  areas.reserve(ply.triangles.size());
  for (const Triangle& t : ply.triangles) {
    const Vec3& a = ply.x0[t[0]];
    const Vec3& b = ply.x0[t[1]];
    const Vec3& c = ply.x0[t[2]];
    areas.push_back((b - a).cross(c - a).norm() / 2);
  }
  return areas;
}

double mean_of_nodes(const PlyFrame& ply, const std::vector<double>& values) {
  const std::vector<double> areas = areas_before(ply);
  double sum = 0.0, area = 0.0;
  for (std::size_t e = 0; e < areas.size(); ++e) {
    for (const std::int32_t node : ply.triangles[e])
      sum += areas[e] / 3.0 * values[static_cast<std::size_t>(node)];
    area += areas[e];
  }
  return sum / area;
}

} // namespace plyform
