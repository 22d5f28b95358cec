// SPDX-License-Identifier: GPL-3.0-or-later
// How HDF5 writes a file, for hdf5_writer.cpp: a driver that keeps the errors of the disk to
// itself. With its own driver HDF5 1.10 goes down in places where a write fails, can no longer
// close the file, and tries that again for ever, or goes down, when the program ends (h5py issue
// 914).
#pragma once

#include "core/results/hdf5_handles.ipp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <iterator>
#include <unistd.h>
#include <utility>
#include <vector>
#if H5_VERSION_GE(1, 13, 0)
#include <H5FDdevelop.h>
#endif

namespace plyform::hdf5 {

/// What has gone wrong with a file that HDF5 writes.
struct Disk {
  int error = 0; ///< errno of the first call that failed
};

[[noreturn]] inline void fail(const std::filesystem::path& path, const std::string& what,
                              const Disk& disk) {
  throw std::runtime_error(
      fmt::format("{}: {}: {}", path.string(), what,
                  disk.error != 0 ? std::generic_category().message(disk.error) : reason()));
}

/// A file as HDF5 sees it: every write succeeds. What is written once one has failed is kept here,
/// as HDF5 may read it again.
class DiskFile {
public:
  DiskFile(int descriptor, Disk* disk) : descriptor_(descriptor), disk_(disk) {}

  void write(haddr_t at, std::size_t size, const char* bytes) {
    end_ = std::max(end_, at + size);
    for (std::size_t done = 0; disk_->error == 0 && done < size;) {
      const ssize_t count =
          pwrite(descriptor_, bytes + done, size - done, static_cast<off_t>(at + done));
      if (count < 0 && errno != EINTR) disk_->error = errno;
      if (count > 0) done += static_cast<std::size_t>(count);
    }
    if (disk_->error != 0) unwritten_.push_back({at, {bytes, bytes + size}});
  }

  /// Zeros where nothing was written, as the file has them.
  void read(haddr_t at, std::size_t size, char* bytes) {
    std::memset(bytes, 0, size);
    for (std::size_t done = 0; done < size;) {
      const ssize_t count =
          pread(descriptor_, bytes + done, size - done, static_cast<off_t>(at + done));
      if (count < 0 && errno == EINTR) continue;
      if (count < 0 && disk_->error == 0) disk_->error = errno;
      if (count <= 0) break;
      done += static_cast<std::size_t>(count);
    }
    for (const auto& [begin, kept] : unwritten_)
      for (haddr_t i = std::max(at, begin); i < std::min(at + size, begin + kept.size()); ++i)
        bytes[i - at] = kept[i - begin];
  }

  void truncate() {
    end_ = allocated;
    if (disk_->error == 0 && ftruncate(descriptor_, static_cast<off_t>(end_)) != 0)
      disk_->error = errno;
  }

  /// What was written is on the disk then.
  void close() {
    if (disk_->error == 0 && fsync(descriptor_) != 0) disk_->error = errno;
    if (::close(descriptor_) != 0 && disk_->error == 0) disk_->error = errno;
  }

  haddr_t end() const { return end_; }
  haddr_t allocated = 0; ///< bytes that HDF5 has given away

private:
  int descriptor_;
  Disk* disk_;
  haddr_t end_ = 0;
  std::vector<std::pair<haddr_t, std::vector<char>>> unwritten_;
};

/// Of HDF5's C interface: its own part first.
struct DriverFile {
  H5FD_t head;
  DiskFile* file;
};

inline DiskFile& file_of(const H5FD_t* file) {
  return *reinterpret_cast<const DriverFile*>(file)->file;
}

inline H5FD_t* open_driver_file(const char* name, unsigned, hid_t access, haddr_t) {
  Disk* const disk = *static_cast<Disk* const*>(H5Pget_driver_info(access));
  unlink(name); // whatever has that name, as a link to another file, is not written into
  const int descriptor = open(name, O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (descriptor < 0) {
    disk->error = errno;
    return nullptr;
  }
  auto* const made = new DriverFile{{}, new DiskFile(descriptor, disk)};
  return &made->head;
}

inline herr_t close_driver_file(H5FD_t* file) {
  auto* const made = reinterpret_cast<DriverFile*>(file);
  made->file->close();
  delete made->file;
  delete made;
  return 0;
}

inline H5FD_class_t driver_class() {
  H5FD_class_t driver{};
#if H5_VERSION_GE(1, 13, 0)
  driver.version = H5FD_CLASS_VERSION;
  driver.value = static_cast<H5FD_class_value_t>(600); // of those left to programs
#endif
  driver.name = "plyform";
  driver.maxaddr = HADDR_MAX / 2 - 1;
  driver.fc_degree = H5F_CLOSE_WEAK;
  driver.fapl_size = sizeof(Disk*);
  driver.open = &open_driver_file;
  driver.close = &close_driver_file;
  driver.query = [](const H5FD_t*, unsigned long* flags) -> herr_t {
    *flags = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE |
             H5FD_FEAT_AGGREGATE_SMALLDATA | H5FD_FEAT_DEFAULT_VFD_COMPATIBLE;
    return 0;
  };
  driver.get_eoa = [](const H5FD_t* file, H5FD_mem_t) { return file_of(file).allocated; };
  driver.set_eoa = [](H5FD_t* file, H5FD_mem_t, haddr_t size) -> herr_t {
    file_of(file).allocated = size;
    return 0;
  };
  driver.get_eof = [](const H5FD_t* file, H5FD_mem_t) { return file_of(file).end(); };
  driver.read = [](H5FD_t* file, H5FD_mem_t, hid_t, haddr_t at, std::size_t size,
                   void* bytes) -> herr_t {
    file_of(file).read(at, size, static_cast<char*>(bytes));
    return 0;
  };
  driver.write = [](H5FD_t* file, H5FD_mem_t, hid_t, haddr_t at, std::size_t size,
                    const void* bytes) -> herr_t {
    file_of(file).write(at, size, static_cast<const char*>(bytes));
    return 0;
  };
  driver.truncate = [](H5FD_t* file, hid_t, hbool_t) -> herr_t {
    file_of(file).truncate();
    return 0;
  };
  const H5FD_mem_t lists[] = H5FD_FLMAP_DICHOTOMY;
  std::copy(std::begin(lists), std::end(lists), driver.fl_map);
  return driver;
}

/// Creates a file whose errors are those of `disk`, which lives longer.
inline Handle create_file(const std::filesystem::path& path, Disk& disk) {
  static const H5FD_class_t driver = driver_class();
  static const hid_t number = H5FDregister(&driver);
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  Disk* const where = &disk;
  if (H5Pset_driver(access.id(), number, &where) < 0) return {};
  return Handle(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access.id()), H5Fclose);
}

} // namespace plyform::hdf5
