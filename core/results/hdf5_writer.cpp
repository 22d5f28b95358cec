// SPDX-License-Identifier: GPL-3.0-or-later
// Writes results.h5. The layout is described in docs/users/results.md.
//
// Every return code is checked, also that of closing a dataset: HDF5 delays small writes until
// then, so that an error of a full disk may appear only there.
#include "core/results/hdf5_handles.ipp"
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
    Handle set(H5Dcreate2(file, where.c_str(), file_type<T>(), space.id(), H5P_DEFAULT, H5P_DEFAULT,
                          H5P_DEFAULT),
               H5Dclose);
    bool ok = set.valid();
    ok = ok &&
         H5Dwrite(set.id(), memory_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0;
    require(set.close() && ok, where);
  }

  /// Creates an array of one entry per frame, which append_to extends.
  template <class T>
  void history(const std::string& where) const {
    const hsize_t none = 0, unlimited = H5S_UNLIMITED, chunk = 256;
    const Handle space(H5Screate_simple(1, &none, &unlimited), H5Sclose);
    const Handle layout(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    H5Pset_chunk(layout.id(), 1, &chunk);
    Handle set(H5Dcreate2(file, where.c_str(), file_type<T>(), space.id(), H5P_DEFAULT, layout.id(),
                          H5P_DEFAULT),
               H5Dclose);
    require(set.valid() && set.close(), where);
  }

  template <class T>
  void append_to(const std::string& where, hsize_t index, T value) const {
    const hsize_t size = index + 1, one = 1;
    Handle set(H5Dopen2(file, where.c_str(), H5P_DEFAULT), H5Dclose);
    bool ok = set.valid() && H5Dset_extent(set.id(), &size) >= 0;
    const Handle all(ok ? H5Dget_space(set.id()) : H5I_INVALID_HID, H5Sclose);
    const Handle single(H5Screate_simple(1, &one, nullptr), H5Sclose);
    ok = ok && H5Sselect_hyperslab(all.id(), H5S_SELECT_SET, &index, nullptr, &one, nullptr) >= 0;
    ok =
        ok && H5Dwrite(set.id(), memory_type<T>(), single.id(), all.id(), H5P_DEFAULT, &value) >= 0;
    require(set.close() && ok, where);
  }

  void attribute(const std::string& where, const char* name, hid_t filed, hid_t in_memory,
                 const Handle& space, const void* values) const {
    Handle made(H5Acreate_by_name(file, where.c_str(), name, filed, space.id(), H5P_DEFAULT,
                                  H5P_DEFAULT, H5P_DEFAULT),
                H5Aclose);
    bool ok = made.valid();
    ok = ok && H5Awrite(made.id(), in_memory, values) >= 0;
    require(made.close() && ok, where + ":" + name);
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

template <class Item>
std::vector<std::string> names_of(const std::vector<Item>& items) {
  std::vector<std::string> names;
  for (const Item& item : items)
    names.push_back(item.name);
  return names;
}

/// Writes the data that do not change during the run.
void write_constants(const Writer& out, const Frame& frame) {
  out.text("/", "format", "plyform results");
  out.number<std::int64_t>("/", "format_version", layout_version);
  out.text("/", "units", "mm, N, s, degrees, N per yarn, N/mm^2");
  out.texts("/", "plies", names_of(frame.plies));
  out.texts("/", "tools", names_of(frame.tools));
  out.texts("/", "boundaries", names_of(frame.boundaries));
  out.history<double>("/time_s");
  out.history<double>("/stroke_mm");
  out.history<std::int64_t>("/step");
  out.group("/plies");
  out.group("/tools");
  for (const PlyFrame& ply : frame.plies) {
    const std::string where = "/plies/" + ply.name;
    out.group(where);
    out.number("/plies/" + ply.name, "angle_deg", ply.angle_deg);
    out.dataset(where + "/x0", ply.x0);
    out.dataset(where + "/triangles", ply.triangles);
  }
  for (const ToolFrame& tool : frame.tools) {
    const std::string where = "/tools/" + tool.name;
    out.group(where);
    out.dataset(where + "/x0", tool.surface.x);
    out.dataset(where + "/triangles", tool.surface.triangles);
  }
}

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
}

void write_boundary(const Writer& out, const std::string& where, const BoundaryFrame& boundary) {
  out.group(where);
  out.vector(where, "force_vector_N", boundary.force);
  out.number(where, "stroke_mm", boundary.stroke_mm);
  out.number(where, "force_N", boundary.force_N);
}

/// Upper estimate of the bytes that a frame adds to the file.
std::size_t bytes_needed(const Frame& frame, bool with_constants) {
  // Headers, symbol tables and names: measured 0.6 kB per dataset or group, taken as 2 kB.
  constexpr std::size_t object = 2048, slack = 65536;
  const std::size_t point = sizeof(Vec3), triangle = sizeof(Triangle), number = sizeof(double);
  std::size_t bytes = slack;
  for (const PlyFrame& ply : frame.plies) {
    const std::size_t n = ply.x.size(), m = ply.triangles.size();
    bytes += (2 + node_scalars.size() + node_vectors.size() + cell_vectors.size() +
              cell_scalars.size()) *
             object;
    bytes += n * (point + node_scalars.size() * number);
    for (const auto& field : node_vectors)
      bytes += (ply.*field.values).size() * point;
    bytes += m * (cell_vectors.size() * point + cell_scalars.size() * number);
    if (with_constants) bytes += 3 * object + n * point + m * triangle;
  }
  bytes += frame.boundaries.size() * object;
  for (const ToolFrame& tool : frame.tools) {
    bytes += object;
    if (with_constants)
      bytes +=
          3 * object + tool.surface.x.size() * point + tool.surface.triangles.size() * triangle;
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

/// Names and mesh sizes of plies and tools as text, to check that they do not change during a run.
std::string shape_of(const Frame& frame) {
  std::string shape;
  for (const PlyFrame& ply : frame.plies)
    shape += fmt::format("{}/{}/{}\n", ply.name, ply.x0.size(), ply.triangles.size());
  shape += "tools\n";
  for (const ToolFrame& tool : frame.tools)
    shape +=
        fmt::format("{}/{}/{}\n", tool.name, tool.surface.x.size(), tool.surface.triangles.size());
  shape += "boundaries\n";
  for (const BoundaryFrame& boundary : frame.boundaries)
    shape += boundary.name + "\n";
  return shape;
}

} // namespace

struct StateFile::Impl {
  fs::path path;
  fs::path temporary; ///< path of the file until its first frame is complete
  Handle file;
  std::size_t frames = 0;
  std::string shape; ///< shape_of the first frame

  void create(const Frame& frame);
  void reserve(std::size_t bytes) const;
  void write(const Frame& frame) const;
  void flush() const;
};

StateFile::StateFile(fs::path path) : impl_(new Impl{std::move(path), {}, {}, 0, {}}) {
  impl_->temporary = impl_->path;
  impl_->temporary += ".tmp";
}

StateFile::~StateFile() {
  const QuietErrors quiet;
  if (!impl_->file.valid()) return;
  impl_->file.close();
  std::error_code ignored;
  if (impl_->frames == 0) fs::remove(impl_->temporary, ignored);
}

std::size_t StateFile::frames() const {
  return impl_->frames;
}

void StateFile::Impl::create(const Frame& frame) {
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  // Without the file lock ParaView and h5py can read the results during the run.
  H5Pset_file_locking(access.id(), false, true);
  file = Handle(H5Fcreate(temporary.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access.id()), H5Fclose);
  if (!file.valid()) fail(path, "cannot create the file");
  shape = shape_of(frame);
}

/// Reserves disk space for a frame before HDF5 writes any of it. If a write fails inside HDF5, the
/// file can neither be closed nor the process ended regularly (h5py issue 914, also observed
/// with 1.10.8); if the reservation fails, the file keeps the frames that it has.
void StateFile::Impl::reserve(std::size_t bytes) const {
  const int error =
      posix_fallocate(descriptor(file.id()), size_of(file.id()), static_cast<off_t>(bytes));
  // not supported by this file system
  if (error == EINVAL || error == EOPNOTSUPP || error == ENODEV) return;
  if (error != 0)
    throw std::runtime_error(fmt::format("{}: cannot write the next state ({} bytes): {}",
                                         path.string(), bytes,
                                         std::generic_category().message(error)));
}

void StateFile::Impl::write(const Frame& frame) const {
  const Writer out{path, file.id()};
  if (frames == 0) write_constants(out, frame);
  const std::string where = frame_group(frames);
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
  // Written last, as readers take their length as the number of complete frames.
  out.append_to("/step", frames, static_cast<std::int64_t>(frame.step));
  out.append_to("/stroke_mm", frames, frame.stroke_mm);
  out.append_to("/time_s", frames, frame.time);
}

void StateFile::Impl::flush() const {
  if (H5Fflush(file.id(), H5F_SCOPE_GLOBAL) < 0) fail(path, "cannot write");
  // Releases reserved space that was not used.
  if (ftruncate(descriptor(file.id()), size_of(file.id())) != 0)
    throw std::runtime_error(
        fmt::format("{}: cannot write: {}", path.string(), std::generic_category().message(errno)));
}

void StateFile::append(const Frame& frame) {
  const QuietErrors quiet;
  Impl& my = *impl_;
  if (my.frames > 0 && !my.file.valid())
    throw std::logic_error(my.path.string() + ": a frame was added after the file was closed");
  if (my.frames > 0 && my.shape != shape_of(frame))
    throw std::logic_error(my.path.string() + ": names or sizes differ from the first frame's");
  if (my.frames == 0) my.create(frame);
  my.reserve(bytes_needed(frame, my.frames == 0));
  my.write(frame);
  my.flush();
  if (my.frames == 0) {
    std::error_code error;
    fs::rename(my.temporary, my.path, error);
    if (error)
      throw std::runtime_error(
          fmt::format("{}: cannot replace the file: {}", my.path.string(), error.message()));
  }
  ++my.frames;
}

void StateFile::close() {
  const QuietErrors quiet;
  if (!impl_->file.close()) fail(impl_->path, "cannot close the file");
}

void leave_hdf5_at_exit() {
  H5dont_atexit();
}

} // namespace plyform
