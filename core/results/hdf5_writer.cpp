// SPDX-License-Identifier: GPL-3.0-or-later
// Writes the files that results.h5 is made of. The layout is described in docs/users/results.md.
//
// Every return code is checked, also that of closing a dataset: HDF5 delays small writes until
// then, so that an error of a full disk may appear only there.
#include "core/results/hdf5_copy.ipp"
#include "core/results/result_fields.hpp"

#include <algorithm>
#include <cerrno>
#include <fcntl.h>
#include <stdexcept>
#include <system_error>
#include <unistd.h>

namespace plyform {

namespace fs = std::filesystem;

using namespace hdf5;

namespace {

/// Writes datasets to a file; `where` in its functions is a path inside the file.
struct Writer {
  const fs::path& path; ///< of the file, for messages
  hid_t file;

  /// To be called before any other call of HDF5, which would forget the reason.
  void require(bool ok, const std::string& what) const {
    if (!ok) fail(path, "cannot write " + what);
  }

  void group(const std::string& where) const {
    const Handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
    H5Pset_create_intermediate_group(links.id(), 1);
    Handle made(H5Gcreate2(file, where.c_str(), links.id(), H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
    require(made.valid() && made.close(), where);
  }

  template <class T>
  void dataset(const std::string& where, const std::vector<T>& values) const {
    const hsize_t size[2] = {values.size(), columns<T>};
    const Handle space(H5Screate_simple(columns<T> == 1 ? 1 : 2, size, nullptr), H5Sclose);
    const Handle layout(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    H5Pset_obj_track_times(layout.id(), false); // the same bytes whenever it is written
    Handle set(H5Dcreate2(file, where.c_str(), file_type<T>(), space.id(), H5P_DEFAULT, layout.id(),
                          H5P_DEFAULT),
               H5Dclose);
    require(set.valid() && H5Dwrite(set.id(), memory_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT,
                                    values.data()) >= 0,
            where);
    require(set.close(), where);
  }

  void attribute(const std::string& where, const char* name, hid_t filed, hid_t in_memory,
                 const Handle& space, const void* values) const {
    Handle made(H5Acreate_by_name(file, where.c_str(), name, filed, space.id(), H5P_DEFAULT,
                                  H5P_DEFAULT, H5P_DEFAULT),
                H5Aclose);
    require(made.valid() && H5Awrite(made.id(), in_memory, values) >= 0, where + ":" + name);
    require(made.close(), where + ":" + name);
  }

  template <class T>
  void number(const std::string& where, const char* name, T value) const {
    const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
    attribute(where, name, file_type<T>(), memory_type<T>(), space, &value);
  }

  void vector(const std::string& where, const char* name, const Vec3& value) const {
    const hsize_t size = 3;
    const Handle space(H5Screate_simple(1, &size, nullptr), H5Sclose);
    attribute(where, name, file_type<Vec3>(), memory_type<Vec3>(), space, value.data());
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
    const Handle type = utf8_type(length);
    const Handle space(H5Screate_simple(1, &size, nullptr), H5Sclose);
    attribute(where, name, type.id(), type.id(), space, padded.data());
  }

  void text(const std::string& where, const char* name, const std::string& value) const {
    const Handle type = utf8_type(value.size());
    const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
    attribute(where, name, type.id(), type.id(), space, value.data());
  }
};

void write_ply(const Writer& out, const std::string& where, const PlyFrame& ply) {
  out.group(where);
  out.dataset(where + "/x", ply.x);
  for (const auto& field : node_scalars)
    out.dataset(where + "/" + field.name, ply.*field.values);
  for (const auto& field : node_vectors)
    if (!(ply.*field.values).empty()) out.dataset(where + "/" + field.name, ply.*field.values);
  for (const auto& field : cell_vectors)
    out.dataset(where + "/" + field.name, ply.*field.values);
  for (const auto& field : cell_scalars)
    out.dataset(where + "/" + field.name, ply.*field.values);
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

/// Upper estimate of the bytes of an object's headers, symbol tables and names: measured 0.6 kB per
/// dataset or group; and of a file without any.
constexpr std::size_t object = 2048, slack = 65536;

std::size_t bytes_of_constants(const Frame& frame) {
  const auto mesh = [](std::size_t nodes, std::size_t triangles) {
    return 3 * object + nodes * sizeof(Vec3) + triangles * sizeof(Triangle);
  };
  std::size_t bytes = slack;
  for (const PlyFrame& ply : frame.plies)
    bytes += mesh(ply.x0.size(), ply.triangles.size());
  for (const ToolFrame& tool : frame.tools)
    bytes += mesh(tool.surface.x.size(), tool.surface.triangles.size());
  return bytes;
}

std::size_t bytes_of_frame(const Frame& frame) {
  std::size_t bytes = slack + (frame.boundaries.size() + frame.tools.size()) * object;
  for (const PlyFrame& ply : frame.plies) {
    const std::size_t n = ply.x.size(), m = ply.triangles.size();
    bytes += (2 + node_scalars.size() + node_vectors.size() + cell_vectors.size() +
              cell_scalars.size()) *
             object;
    bytes += n * (sizeof(Vec3) + node_scalars.size() * sizeof(double));
    for (const auto& field : node_vectors)
      bytes += (ply.*field.values).size() * sizeof(Vec3);
    bytes += m * (cell_vectors.size() * sizeof(Vec3) + cell_scalars.size() * sizeof(double));
  }
  return bytes;
}

/// The file descriptor that HDF5 writes to; -1 if it is not available.
int descriptor(hid_t file) {
  void* found = nullptr;
  return H5Fget_vfd_handle(file, H5P_DEFAULT, &found) < 0 ? -1 : *static_cast<int*>(found);
}

/// Size (bytes) of the file according to HDF5; the file on disk may be longer by the reserved
/// space.
off_t size_of(hid_t file) {
  hsize_t size = 0;
  H5Fget_filesize(file, &size);
  return static_cast<off_t>(size);
}

/// A file that gets its name when it is complete and on the disk; else nothing of it stays.
class WholeFile {
public:
  /// Reserves disk space before HDF5 writes anything. If a write fails inside HDF5, the file can
  /// neither be closed nor the process ended regularly (h5py issue 914, also observed with 1.10.8).
  WholeFile(const fs::path& path, std::size_t bytes) : path_(path), temporary_(path) {
    temporary_ += ".tmp";
    try {
      create(bytes);
    } catch (...) {
      remove();
      throw;
    }
  }
  ~WholeFile() {
    if (!complete_) remove();
  }
  WholeFile(const WholeFile&) = delete;
  WholeFile& operator=(const WholeFile&) = delete;

  Writer writer() const { return {path_, file_.id()}; }

  void complete() {
    if (H5Fflush(file_.id(), H5F_SCOPE_GLOBAL) < 0) hdf5::fail(path_, "cannot write");
    // Releases reserved space that was not used.
    if (ftruncate(descriptor(file_.id()), size_of(file_.id())) != 0) fail("write", errno);
    const Descriptor own(dup(descriptor(file_.id()))); // closing writes the head of the file again
    if (own.number < 0) fail("write", errno);
    if (!file_.close()) hdf5::fail(path_, "cannot close the file");
    if (fsync(own.number) != 0) fail("write", errno);
    std::error_code error;
    fs::rename(temporary_, path_, error);
    if (error) fail("replace the file", error.value());
    complete_ = true;
  }

private:
  struct Descriptor {
    explicit Descriptor(int descriptor) : number(descriptor) {}
    ~Descriptor() {
      if (number >= 0) ::close(number);
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    int number;
  };

  void create(std::size_t bytes) {
    const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    H5Pset_file_locking(access.id(), false, true); // others may read while this is written
    file_ =
        Handle(H5Fcreate(temporary_.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access.id()), H5Fclose);
    if (!file_.valid()) hdf5::fail(path_, "cannot create the file");
    const int error =
        posix_fallocate(descriptor(file_.id()), size_of(file_.id()), static_cast<off_t>(bytes));
    if (error == 0 || error == EINVAL || error == EOPNOTSUPP || error == ENODEV)
      return; // or not supported by this file system
    fail(fmt::format("write {} bytes", bytes), error);
  }

  [[noreturn]] void fail(const std::string& what, int error) const {
    throw std::runtime_error(fmt::format("{}: cannot {}: {}", path_.string(), what,
                                         std::generic_category().message(error)));
  }

  void remove() {
    file_.close();
    std::error_code ignored;
    fs::remove(temporary_, ignored);
  }

  fs::path path_, temporary_;
  Handle file_;
  bool complete_ = false;
};

/// Attributes of the file, and an entry a frame of times.
void write_index(const Writer& out, const StateIndex& index) {
  out.text("/", "format", "plyform results");
  out.number<std::int64_t>("/", "format_version", layout_version);
  out.text("/", "units", "mm, N, s, degrees, N per yarn, N/mm^2");
  out.texts("/", "plies", index.plies);
  out.texts("/", "tools", index.tools);
  out.texts("/", "boundaries", index.boundaries);
  out.dataset("/time_s", index.time);
  out.dataset("/stroke_mm", index.stroke);
  out.dataset("/step", index.step);
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
  WholeFile file(path, bytes_of_constants(frame));
  const Writer out = file.writer();
  out.group("/plies");
  out.group("/tools");
  for (const PlyFrame& ply : frame.plies) {
    const std::string where = "/plies/" + ply.name;
    out.group(where);
    out.dataset(where + "/x0", ply.x0);
    out.dataset(where + "/triangles", ply.triangles);
    out.number(where, "angle_deg", ply.angle_deg);
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
  WholeFile file(path, bytes_of_frame(frame));
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
  WholeFile file(path, slack + parts.size() * object);
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
  std::size_t bytes = slack + parts.size() * object;
  for (const Part& part : parts)
    bytes += fs::file_size(path.parent_path() / part.file);
  WholeFile file(path, bytes);
  const Writer out = file.writer();
  write_index(out, index);
  for (const Part& part : parts) {
    const fs::path from = path.parent_path() / part.file;
    const Handle source(H5Fopen(from.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
    out.require(source.valid(), part.name);
    Copier{path, source.id(), out.file}.object(part.name);
  }
  file.complete();
}

void leave_hdf5_at_exit() {
  H5dont_atexit();
}

} // namespace plyform
