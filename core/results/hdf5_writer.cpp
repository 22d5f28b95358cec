// SPDX-License-Identifier: GPL-3.0-or-later
// Writes the files that results.h5 is made of. The layout is described in docs/users/results.md.
//
// Errors of the disk are those that core/results/hdf5_disk.ipp remembers. HDF5 delays small writes:
// many appear only when a file is closed.
#include "base/version.hpp"
#include "core/results/hdf5_disk.ipp"
#include "core/results/result_fields.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <stdexcept>
#include <system_error>

namespace plyform {

namespace fs = std::filesystem;

using namespace hdf5;

namespace {

/// Types and spaces that many attributes share: most of an attribute's time is in making them.
class SharedTypes {
public:
  hid_t text(std::size_t length) {
    const auto [found, added] = texts_.try_emplace(length);
    if (added) found->second = utf8_type(length);
    return found->second.id();
  }
  const Handle& scalar() const { return scalar_; }

private:
  std::map<std::size_t, Handle> texts_; ///< by their length, bytes
  Handle scalar_{H5Screate(H5S_SCALAR), H5Sclose};
};

/// Writes datasets to a file; `where` in its functions is a path inside the file.
struct Writer {
  const fs::path& path; ///< of the file, for messages
  hid_t file;
  const Disk& disk; ///< that of the file
  SharedTypes& shared;

  void require(bool ok, const std::string& what) const {
    if (!ok || disk.error != 0) fail(path, "cannot write " + what, disk);
  }

  void group(const std::string& where) const {
    const Handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
    H5Pset_create_intermediate_group(links.id(), 1);
    Handle made(H5Gcreate2(file, where.c_str(), links.id(), H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
    require(made.valid() && made.close(), where);
  }

  /// describe: gives the open dataset, as the `file` of a writer, its attributes.
  template <class T>
  void dataset(const std::string& where, const std::vector<T>& values,
               const std::function<void(const Writer&)>& describe = {}) const {
    const hsize_t size[2] = {values.size(), columns<T>};
    const Handle space(H5Screate_simple(columns<T> == 1 ? 1 : 2, size, nullptr), H5Sclose);
    const Handle layout(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    const Handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
    H5Pset_create_intermediate_group(links.id(), 1);
    H5Pset_obj_track_times(layout.id(), false); // the same bytes whenever it is written
    Handle set(H5Dcreate2(file, where.c_str(), file_type<T>(), space.id(), links.id(), layout.id(),
                          H5P_DEFAULT),
               H5Dclose);
    require(set.valid() && H5Dwrite(set.id(), memory_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT,
                                    values.data()) >= 0,
            where);
    if (describe) describe({path, set.id(), disk, shared});
    require(set.close(), where);
  }

  /// where: "." is what is open as `file`.
  void attribute(const std::string& where, const char* name, hid_t filed, hid_t in_memory,
                 const Handle& space, const void* values) const {
    const hid_t id = where == "."
                         ? H5Acreate2(file, name, filed, space.id(), H5P_DEFAULT, H5P_DEFAULT)
                         : H5Acreate_by_name(file, where.c_str(), name, filed, space.id(),
                                             H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    Handle made(id, H5Aclose);
    require(made.valid() && H5Awrite(made.id(), in_memory, values) >= 0, where + ":" + name);
    require(made.close(), where + ":" + name);
  }

  template <class T>
  void number(const std::string& where, const char* name, T value) const {
    attribute(where, name, file_type<T>(), memory_type<T>(), shared.scalar(), &value);
  }

  void vector(const std::string& where, const char* name, const Vec3& value) const {
    const hsize_t size = 3;
    const Handle space(H5Screate_simple(1, &size, nullptr), H5Sclose);
    attribute(where, name, file_type<Vec3>(), memory_type<Vec3>(), space, value.data());
  }

  void numbers(const std::string& where, const char* name,
               const std::vector<double>& values) const {
    const hsize_t size = values.size();
    const Handle space(H5Screate_simple(1, &size, nullptr), H5Sclose);
    const double none = 0.0; // HDF5 takes no null, not even for no numbers
    attribute(where, name, file_type<double>(), memory_type<double>(), space,
              values.empty() ? &none : values.data());
  }

  void texts(const std::string& where, const char* name,
             const std::vector<std::string>& values) const {
    std::size_t length = 1; // bytes of the longest
    for (const std::string& value : values)
      length = std::max(length, value.size());
    std::string padded;
    for (const std::string& value : values)
      padded += value + std::string(length - value.size(), '\0');
    const hsize_t size = values.size();
    const hid_t type = shared.text(length);
    const Handle space(H5Screate_simple(1, &size, nullptr), H5Sclose);
    attribute(where, name, type, type, space, padded.data());
  }

  void text(const std::string& where, const char* name, const std::string& value) const {
    const hid_t type = shared.text(value.size());
    attribute(where, name, type, type, shared.scalar(), value.data());
  }
};

/// Attributes of an open dataset: what its values are.
void describe(const Writer& set, const Description& what, Location location) {
  set.text(".", "place", word_of(location));
  set.text(".", "label", what.label);
  set.text(".", "word", what.word);
  set.text(".", "unit", what.unit);
  set.number<std::int64_t>(".", "digits", what.digits);
  set.number(".", "precision", what.precision);
  set.text(".", "scale", word_of(what.scale));
  if (!what.note.empty()) set.text(".", "note", what.note);
}

/// Attributes of a ply: what its columns are named by.
void write_families(const Writer& out, const std::string& where, const PlyFrame& ply) {
  std::vector<std::string> families, stitches, crossings;
  std::vector<double> angles, stitch_angles;
  for (const FamilyFrame& family : ply.families) {
    families.push_back(family.name);
    angles.push_back(family.angle_deg);
  }
  for (const StitchFrame& stitch : ply.stitches) {
    stitches.push_back(stitch.name);
    stitch_angles.push_back(stitch.angle_deg);
  }
  for (const CrossingFrame& crossing : ply.crossings)
    crossings.push_back(crossing.suffix);
  out.texts(where, "families", families);
  out.numbers(where, "family_angles_deg", angles);
  if (!stitches.empty()) {
    out.texts(where, "stitches", stitches);
    out.numbers(where, "stitch_angles_deg", stitch_angles);
  }
  out.texts(where, "further_crossings", crossings);
  std::vector<std::string> columns;
  for (const Column& column : columns_of(ply))
    columns.push_back(column.name);
  out.texts(where, "columns", columns);
}

void write_ply(const Writer& out, const std::string& where, const PlyFrame& ply) {
  out.group(where);
  out.dataset(where + "/x", ply.x);
  each_column(ply, [&](const Column& column, const auto& values) {
    if (column.may_lack && values.empty()) return;
    out.dataset(where + "/" + column.name, values, [&](const Writer& set) {
      describe(set, column, column.location);
      if (!column.quantity.empty()) set.text(".", "quantity", column.quantity);
    });
  });
}

void write_tool(const Writer& out, const std::string& where, const ToolFrame& tool) {
  out.group(where);
  out.vector(where, "displacement_mm", tool.displacement);
  out.vector(where, "force_vector_N", tool.force);
  out.number(where, "stroke_mm", tool.stroke_mm);
  out.number(where, "force_N", tool.force_N);
  out.number(where, "force_raw_N", tool.force_raw_N);
}

void write_boundary(const Writer& out, const std::string& where, const BoundaryFrame& boundary) {
  out.group(where);
  out.vector(where, "force_vector_N", boundary.force);
  out.number(where, "stroke_mm", boundary.stroke_mm);
  out.number(where, "force_N", boundary.force_N);
}

/// A file that gets its name when it is complete and on the disk; else nothing of it stays.
class WholeFile {
public:
  explicit WholeFile(const fs::path& path) : path_(path), temporary_(path) {
    temporary_ += ".tmp";
    file_ = create_file(temporary_, disk_);
    if (file_.valid()) return;
    std::error_code ignored;
    fs::remove(temporary_, ignored);
    fail(path_, "cannot create the file", disk_);
  }
  ~WholeFile() {
    if (complete_) return;
    file_.close();
    std::error_code ignored;
    fs::remove(temporary_, ignored);
  }
  WholeFile(const WholeFile&) = delete;
  WholeFile& operator=(const WholeFile&) = delete;

  Writer writer() { return {path_, file_.id(), disk_, shared_}; }

  void complete() {
    if (!file_.close() || disk_.error != 0) fail(path_, "cannot write", disk_);
    std::error_code error;
    fs::rename(temporary_, path_, error);
    if (error)
      throw std::runtime_error(
          fmt::format("{}: cannot replace the file: {}", path_.string(), error.message()));
    complete_ = true;
  }

private:
  fs::path path_, temporary_;
  Disk disk_;
  SharedTypes shared_;
  Handle file_;
  bool complete_ = false;
};

/// Where the series of a number stands; those of the run itself stand at the top.
std::string path_of(const StateNumber& number) {
  if (number.energy) return "/history/energies/" + number.name;
  const std::string rest = "/" + number.body + "/" + number.name;
  switch (number.location) {
  case Location::ply:
    return "/history/plies" + rest;
  case Location::tool:
    return "/history/tools" + rest;
  case Location::boundary:
    return "/history/boundaries" + rest;
  default:
    return "/" + number.name;
  }
}

/// Attributes of the file, and an entry a frame of its numbers.
void write_index(const Writer& out, const StateIndex& index) {
  out.text("/", "format", "plyform results");
  out.number<std::int64_t>("/", "format_version", layout_version);
  out.text("/", "plyform_version", version());
  out.text("/", "units", "mm, N, s, degrees, N per yarn, N/mm^2");
  out.texts("/", "plies", index.plies);
  out.texts("/", "tools", index.tools);
  out.texts("/", "boundaries", index.boundaries);
  out.dataset("/step", index.step);
  for (const char* group :
       {"/history/energies", "/history/plies", "/history/tools", "/history/boundaries"})
    out.group(group);
  std::map<std::string, std::vector<std::string>> names; // by group, in order
  for (const Series& series : index.history) {
    const std::string where = path_of(series.what);
    out.dataset(where, series.values,
                [&](const Writer& set) { describe(set, series.what, series.what.location); });
    names[where.substr(0, where.rfind('/'))].push_back(series.what.name);
  }
  for (const auto& [group, own] : names)
    out.texts(group.empty() ? "/" : group, "numbers", own);
}

/// What an index refers to: path of a file from the folder of results.h5, of a group in it, and of
/// that group in results.h5.
struct Part {
  std::string file, group, name;
};

std::vector<Part> parts_of(const StateIndex& index) {
  std::vector<Part> parts;
  for (const char* group : {"/plies", "/tools"})
    parts.push_back({constants_file().string(), group, group});
  for (std::size_t i = 0; i < index.step.size(); ++i)
    parts.push_back({state_file(i).string(), frame_group(i), frame_group(i)});
  return parts;
}

} // namespace

fs::path constants_file() {
  return fs::path("states") / "meshes.h5";
}

fs::path state_file(std::size_t index) {
  return fs::path("states") / fmt::format("{:06}.h5", index);
}

void write_constants(const fs::path& path, const Frame& frame) {
  const QuietErrors quiet;
  WholeFile file(path);
  const Writer out = file.writer();
  out.group("/plies");
  out.group("/tools");
  for (const PlyFrame& ply : frame.plies) {
    const std::string where = "/plies/" + ply.name;
    out.group(where);
    out.dataset(where + "/x0", ply.x0);
    out.dataset(where + "/triangles", ply.triangles);
    out.number(where, "angle_deg", ply.angle_deg);
    write_families(out, where, ply);
  }
  for (const ToolFrame& tool : frame.tools) {
    const std::string where = "/tools/" + tool.name;
    out.group(where);
    out.dataset(where + "/x0", tool.surface.x);
    out.dataset(where + "/triangles", tool.surface.triangles);
  }
  file.complete();
}

void write_state(const fs::path& path, const Frame& frame, std::size_t index) {
  const QuietErrors quiet;
  WholeFile file(path);
  const Writer out = file.writer();
  const std::string where = frame_group(index);
  out.group(where);
  out.number(where, "time_s", frame.time);
  out.number(where, "stroke_mm", frame.stroke_mm);
  out.number<std::int64_t>(where, "step", frame.step);
  for (const PlyFrame& ply : frame.plies)
    write_ply(out, where + "/plies/" + ply.name, ply);
  for (const ToolFrame& tool : frame.tools)
    write_tool(out, where + "/tools/" + tool.name, tool);
  for (const BoundaryFrame& boundary : frame.boundaries)
    write_boundary(out, where + "/boundaries/" + boundary.name, boundary);
  file.complete();
}

void write_linked(const fs::path& path, const StateIndex& index) {
  const QuietErrors quiet;
  const std::vector<Part> parts = parts_of(index);
  WholeFile file(path);
  const Writer out = file.writer();
  write_index(out, index);
  const Handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
  H5Pset_create_intermediate_group(links.id(), 1);
  for (const Part& part : parts)
    out.require(H5Lcreate_external(part.file.c_str(), part.group.c_str(), out.file,
                                   part.name.c_str(), links.id(), H5P_DEFAULT) >= 0,
                part.name);
  file.complete();
}

void write_merged(const fs::path& path, const StateIndex& index) {
  const QuietErrors quiet;
  const std::vector<Part> parts = parts_of(index);
  WholeFile file(path);
  const Writer out = file.writer();
  write_index(out, index);
  const Handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
  H5Pset_create_intermediate_group(links.id(), 1);
  for (const Part& part : parts) {
    const fs::path from = path.parent_path() / part.file;
    const Handle source(H5Fopen(from.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
    out.require(source.valid() && H5Ocopy(source.id(), part.group.c_str(), out.file,
                                          part.name.c_str(), H5P_DEFAULT, links.id()) >= 0,
                part.name);
  }
  file.complete();
}

} // namespace plyform
