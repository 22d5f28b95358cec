// SPDX-License-Identifier: GPL-3.0-or-later
// Reads a whole frame of results.h5. The layout is described in docs/users/results.md.
//
// The file is not trusted: types, sizes and node numbers are checked before they are used, and
// numbers must be finite. HDF5 itself goes down, or never comes back, on some damaged files; hence
// it reads in a process of its own.
#include "base/helper_process.hpp"
#include "base/names.hpp"
#include "base/text.hpp"
#include "core/results/frame_bytes.hpp"
#include "core/results/hdf5_links.ipp"
#include "core/results/result_fields.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <set>

namespace plyform {

namespace fs = std::filesystem;
using namespace hdf5;

namespace {

/// Size of the file that an object is in: during a run that of its state.
std::uintmax_t bytes_of_file(hid_t object) {
  std::string name(static_cast<std::size_t>(std::max<ssize_t>(H5Fget_name(object, nullptr, 0), 0)),
                   '\0');
  H5Fget_name(object, name.data(), name.size() + 1);
  std::error_code error;
  const std::uintmax_t bytes = fs::file_size(name, error);
  return error ? 0 : bytes;
}

/// Reads datasets of a file; `where` in its functions is a path inside the file.
struct Reader {
  const fs::path& path; ///< of the file
  hid_t file;
  mutable std::set<std::string> followed{}; ///< links that may be

  [[noreturn]] void broken(const std::string& where, const std::string& what) const {
    throw std::runtime_error(fmt::format(
        "{}: {} {}; the file is damaged or not by this version of plyform: run the case again",
        path.string(), shown(where, 200), what));
  }

  /// Throws if a link on the way to `where` leads out of the results. To be called before HDF5 goes
  /// that way.
  void follow(const std::string& where) const {
    for (std::size_t end = 0; end != std::string::npos;) {
      end = where.find('/', end + 1);
      const std::string part = where.substr(0, end);
      if (part.size() < 2 || !followed.insert(part).second) continue;
      if (const std::string fault = fault_of_link(file, part, path.parent_path()); !fault.empty())
        broken(part, fault);
    }
  }

  bool has(const std::string& where) const {
    follow(where);
    return H5Lexists(file, where.c_str(), H5P_DEFAULT) > 0;
  }

  /// Throws unless a type of the file is that of numbers: converting any other may do anything.
  void expect_numbers(const std::string& where, const Handle& type) const {
    const H5T_class_t kind = H5Tget_class(type.id());
    const std::size_t size = H5Tget_size(type.id());
    if ((kind != H5T_INTEGER && kind != H5T_FLOAT) || size == 0 || size > 8)
      broken(where, "holds no numbers");
  }

  void expect_finite(const std::string& where, const double* values, std::size_t count) const {
    if (!std::all_of(values, values + count, [](double x) { return std::isfinite(x); }))
      broken(where, "holds a number that is not finite");
  }

  template <class T>
  std::vector<T> dataset(const std::string& where) const {
    follow(where);
    const Handle set(H5Dopen2(file, where.c_str(), H5P_DEFAULT), H5Dclose);
    if (!set.valid()) broken(where, "is missing");
    if (const std::string fault = fault_of_storage(set.id()); !fault.empty()) broken(where, fault);
    const Handle space(H5Dget_space(set.id()), H5Sclose);
    hsize_t size[2] = {0, 1};
    const int dimensions = H5Sget_simple_extent_ndims(space.id());
    if (dimensions != (columns<T> == 1 ? 1 : 2)) broken(where, "has a wrong shape");
    H5Sget_simple_extent_dims(space.id(), size, nullptr);
    if (size[1] != columns<T>) broken(where, "has a wrong shape");
    expect_numbers(where, Handle(H5Dget_type(set.id()), H5Tclose));
    // With a damaged header no more memory must be allocated than the file has bytes.
    if (size[0] > bytes_of_file(set.id()) / sizeof(T)) broken(where, "is larger than the file");
    std::vector<T> values(size[0]);
    if (H5Dread(set.id(), memory_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
      broken(where, "cannot be read (" + reason() + ")");
    if constexpr (std::is_same_v<T, double>) expect_finite(where, values.data(), values.size());
    if constexpr (std::is_same_v<T, Vec3>)
      if (!values.empty()) expect_finite(where, values.front().data(), 3 * values.size());
    return values;
  }

  /// A dataset of `rows` entries of one number each. Throws if it has another size.
  template <class T>
  std::vector<T> dataset(const std::string& where, std::size_t rows) const {
    std::vector<T> values = dataset<T>(where);
    if (values.size() != rows)
      broken(where, fmt::format("has {} rows in place of {}", values.size(), rows));
    return values;
  }

  std::vector<Triangle> triangles(const std::string& where, std::size_t nodes) const {
    std::vector<Triangle> values = dataset<Triangle>(where);
    for (const Triangle& triangle : values)
      for (const std::int32_t node : triangle)
        if (node < 0 || static_cast<std::size_t>(node) >= nodes)
          broken(where, fmt::format("names node {} of {} nodes", node, nodes));
    return values;
  }

  Handle attribute(const std::string& where, const char* name, hsize_t entries) const {
    follow(where);
    Handle found(H5Aopen_by_name(file, where.c_str(), name, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    if (!found.valid()) broken(where + ":" + name, "is missing");
    const Handle space(H5Aget_space(found.id()), H5Sclose);
    if (H5Sget_simple_extent_npoints(space.id()) != static_cast<hssize_t>(entries))
      broken(where + ":" + name, "has a wrong shape");
    expect_numbers(where + ":" + name, Handle(H5Aget_type(found.id()), H5Tclose));
    return found;
  }

  template <class T>
  void number(const std::string& where, const char* name, T& value) const {
    const Handle found = attribute(where, name, 1);
    if (H5Aread(found.id(), memory_type<T>(), &value) < 0)
      broken(where + ":" + name, "cannot be read");
    if constexpr (std::is_same_v<T, double>) expect_finite(where + ":" + name, &value, 1);
  }

  void vector(const std::string& where, const char* name, Vec3& value) const {
    const Handle found = attribute(where, name, 3);
    if (H5Aread(found.id(), memory_type<Vec3>(), value.data()) < 0)
      broken(where + ":" + name, "cannot be read");
    expect_finite(where + ":" + name, value.data(), 3);
  }

  std::vector<double> numbers(const std::string& where, const char* name,
                              std::size_t entries) const {
    const Handle found = attribute(where, name, entries);
    std::vector<double> values(std::max<std::size_t>(entries, 1)); // HDF5 takes no null
    if (H5Aread(found.id(), memory_type<double>(), values.data()) < 0)
      broken(where + ":" + name, "cannot be read");
    values.resize(entries);
    expect_finite(where + ":" + name, values.data(), entries);
    return values;
  }

  std::vector<std::string> texts(const std::string& where, const char* name) const {
    const Handle found(H5Aopen_by_name(file, where.c_str(), name, H5P_DEFAULT, H5P_DEFAULT),
                       H5Aclose);
    if (!found.valid()) broken(where + ":" + name, "is missing");
    const Handle space(H5Aget_space(found.id()), H5Sclose),
        filed(H5Aget_type(found.id()), H5Tclose);
    const std::size_t length = H5Tget_size(filed.id());
    const hssize_t entries = H5Sget_simple_extent_npoints(space.id());
    constexpr std::size_t longest = 4096; // bytes: no name is as long
    constexpr hssize_t most = 100000;     // names
    if (H5Tget_class(filed.id()) != H5T_STRING || H5Tis_variable_str(filed.id()) != 0 ||
        length == 0 || length > longest || entries < 0 || entries > most)
      broken(where + ":" + name, "is no list of names");
    std::string padded(length * static_cast<std::size_t>(entries), '\0');
    const Handle type = utf8_type(length);
    if (H5Aread(found.id(), type.id(), padded.data()) < 0)
      broken(where + ":" + name, "cannot be read");
    std::vector<std::string> values;
    for (std::size_t at = 0; at < padded.size(); at += length) {
      const std::string text = padded.substr(at, length);
      values.push_back(text.substr(0, text.find('\0')));
    }
    return values;
  }
};

/// What the columns of a ply are named by.
void read_families(const Reader& in, const std::string& where, PlyFrame& ply) {
  for (const std::string& name : in.texts(where, "families"))
    ply.families.push_back({name, 0.0, {}, {}, {}});
  const std::vector<double> angles = in.numbers(where, "family_angles_deg", ply.families.size());
  for (std::size_t i = 0; i < angles.size(); ++i)
    ply.families[i].angle_deg = angles[i];
  if (H5Aexists_by_name(in.file, where.c_str(), "stitches", H5P_DEFAULT) > 0) {
    for (const std::string& name : in.texts(where, "stitches"))
      ply.stitches.push_back({{name, 0.0, {}, {}, {}}, {}});
    const std::vector<double> of = in.numbers(where, "stitch_angles_deg", ply.stitches.size());
    for (std::size_t i = 0; i < of.size(); ++i)
      ply.stitches[i].angle_deg = of[i];
  }
  for (const std::string& suffix : in.texts(where, "further_crossings"))
    ply.crossings.push_back({suffix, {}});
  for (const Column& column : columns_of(ply))
    if (const std::string fault = fault_of_file_name(column.name); !fault.empty())
      in.broken(where, fmt::format("names a column that {}", fault));
}

PlyFrame read_ply(const Reader& in, const std::string& group, const std::string& name) {
  PlyFrame ply;
  ply.name = name;
  const std::string fixed = "/plies/" + name, now = group + fixed + "/";
  in.number(fixed, "angle_deg", ply.angle_deg);
  ply.x0 = in.dataset<Vec3>(fixed + "/x0");
  const std::size_t n = ply.x0.size();
  ply.triangles = in.triangles(fixed + "/triangles", n);
  const std::size_t m = ply.triangles.size();
  ply.x = in.dataset<Vec3>(now + "x", n);
  read_families(in, fixed, ply);
  each_column(ply, [&]<class Value>(const Column& column, std::vector<Value>& values) {
    if (!column.may_lack || in.has(now + column.name))
      values = in.dataset<Value>(now + column.name, column.location == Location::node ? n : m);
  });
  return ply;
}

ToolFrame read_tool(const Reader& in, const std::string& group, const std::string& name) {
  ToolFrame tool;
  tool.name = name;
  const std::string fixed = "/tools/" + name, now = group + fixed;
  tool.surface.x = in.dataset<Vec3>(fixed + "/x0");
  tool.surface.triangles = in.triangles(fixed + "/triangles", tool.surface.x.size());
  in.vector(now, "displacement_mm", tool.displacement);
  in.vector(now, "force_vector_N", tool.force);
  in.number(now, "stroke_mm", tool.stroke_mm);
  in.number(now, "force_N", tool.force_N);
  tool.force_raw_N = tool.force_N; // of files from before there was a filter
  if (H5Aexists_by_name(in.file, now.c_str(), "force_raw_N", H5P_DEFAULT) > 0)
    in.number(now, "force_raw_N", tool.force_raw_N);
  return tool;
}

BoundaryFrame read_boundary(const Reader& in, const std::string& group, const std::string& name) {
  BoundaryFrame boundary;
  boundary.name = name;
  const std::string now = group + "/boundaries/" + name;
  in.vector(now, "force_vector_N", boundary.force);
  in.number(now, "stroke_mm", boundary.stroke_mm);
  in.number(now, "force_N", boundary.force_N);
  return boundary;
}

/// The times of all frames, at least one, of a file that this plyform can read.
std::vector<double> times_of(const Reader& in) {
  if (H5Aexists(in.file, "format_version") <= 0) in.broken("format_version", "is missing");
  std::int64_t version = 0;
  in.number("/", "format_version", version);
  if (version != layout_version)
    throw std::runtime_error(
        fmt::format("{}: its layout is version {}, this plyform reads version {}: run the case "
                    "again, or read it with h5py",
                    in.path.string(), version, layout_version));
  if (!in.has("/time_s") || !in.has("/frames")) in.broken("/frames or /time_s", "is missing");
  std::vector<double> times = in.dataset<double>("/time_s");
  if (times.empty()) in.broken("/time_s", "is empty: the run was stopped before its first state");
  return times;
}

/// Reads it in this process.
Frame read_here(const fs::path& path, long index) {
  const QuietErrors quiet;
  const Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  if (!file.valid()) fail(path, "cannot be opened as results of a run");
  const Reader in{path, file.id()};
  const std::vector<double> times = times_of(in);
  const long count = static_cast<long>(times.size()),
             from_first = index < 0 ? count + index : index;
  if (from_first < 0 || from_first >= count)
    throw std::runtime_error(
        fmt::format("{}: has no frame {}, but {} from 0", path.string(), index, count));
  const std::string group = frame_group(static_cast<std::size_t>(from_first));
  Frame frame;
  frame.time = times[static_cast<std::size_t>(from_first)];
  in.number(group, "stroke_mm", frame.stroke_mm);
  std::int64_t step = 0;
  in.number(group, "step", step);
  frame.step = static_cast<long>(step);
  for (const std::string& name : in.texts("/", "plies"))
    frame.plies.push_back(read_ply(in, group, name));
  for (const std::string& name : in.texts("/", "tools"))
    frame.tools.push_back(read_tool(in, group, name));
  for (const std::string& name : in.texts("/", "boundaries"))
    frame.boundaries.push_back(read_boundary(in, group, name));
  return frame;
}

/// Bytes of results.h5, and of the states that it refers to while a run is in progress.
std::size_t size_with_states(const fs::path& path) {
  std::error_code error;
  std::size_t size = fs::is_regular_file(path, error) ? fs::file_size(path, error) : 0;
  for (const fs::directory_entry& entry :
       fs::directory_iterator(path.parent_path() / state_file(0).parent_path(), error))
    if (entry.is_regular_file(error)) size += entry.file_size(error);
  return size;
}

/// The number of frames as text, read in this process.
std::string count_here(const fs::path& path) {
  const QuietErrors quiet;
  const Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  if (!file.valid()) fail(path, "cannot be opened as results of a run");
  return fmt::to_string(times_of(Reader{path, file.id()}).size());
}

/// What `read` makes of the file, in a process of its own.
std::string read_apart(const fs::path& path, const std::function<std::string()>& read) {
  std::error_code error;
  if (!fs::exists(path, error))
    throw std::runtime_error(
        fmt::format("{}: no such file: give the result folder of a run (plyform run CASE -o DIR)",
                    path.string()));
  if (const std::string fault = fault_of_file(path, std::numeric_limits<std::size_t>::max());
      !fault.empty())
    throw std::runtime_error(
        fmt::format("{}: {}: give the result folder of a run", path.string(), fault));
  const std::size_t size = size_with_states(path);
  constexpr std::size_t slow = 20 << 20; // bytes read in a second, at the least
  HelperLimits limits;
  limits.seconds += static_cast<unsigned>(size / slow);
  limits.bytes += 4 * size;
  const HelperResult result = in_helper_process(read, limits);
  using End = HelperResult::End;
  if (result.end == End::done) return result.text;
  if (result.end == End::refused) throw std::runtime_error(result.text);
  throw std::runtime_error(fmt::format(
      "{}: the file is damaged: HDF5 {}; run the case again, or take a copy of the file",
      path.string(),
      result.end == End::timeout ? "found no end of it" : "failed on it (" + result.text + ")"));
}

} // namespace

Frame read_frame(const fs::path& path, long index) {
  Frame frame =
      frame_from_bytes(read_apart(path, [&] { return frame_to_bytes(read_here(path, index)); }));
  try {
    check_frame(frame); // names become those of files, and must not lead out of a folder
  } catch (const std::exception& error) {
    throw std::runtime_error(path.string() + ": " + error.what());
  }
  return frame;
}

long count_frames(const fs::path& path) {
  return std::stol(read_apart(path, [&] { return count_here(path); }));
}

} // namespace plyform
