// SPDX-License-Identifier: GPL-3.0-or-later
// Copies groups, datasets and attributes from file to file, for hdf5_writer.cpp. H5Ocopy of HDF5
// 1.10 would do that in one call, but goes down where the disk does not take what it writes.
#pragma once

#include "core/results/hdf5_handles.ipp"

#include <algorithm>
#include <string>
#include <vector>

namespace plyform::hdf5 {

struct Copier {
  const std::filesystem::path& path; ///< of the file written, for messages
  hid_t from, to;                    ///< files

  /// Copies the group or dataset `where`, with all in it; groups on the way are made. Throws
  /// std::runtime_error naming the path and the reason.
  void object(const std::string& where) const {
    const Handle source(H5Oopen(from, where.c_str(), H5P_DEFAULT), H5Oclose);
    require(source.valid(), where);
    if (H5Iget_type(source.id()) == H5I_DATASET)
      dataset(source.id(), where);
    else
      group(source.id(), where);
  }

private:
  /// To be called before any other call of HDF5, which would forget the reason.
  void require(bool ok, const std::string& where) const {
    if (!ok) fail(path, "cannot write " + where);
  }

  static std::vector<char> room_for(const Handle& space, const Handle& type) {
    const hssize_t count = H5Sget_simple_extent_npoints(space.id());
    return std::vector<char>(static_cast<std::size_t>(std::max<hssize_t>(count, 0)) *
                             H5Tget_size(type.id()));
  }

  static std::string room_for_name(ssize_t length) {
    return std::string(static_cast<std::size_t>(std::max<ssize_t>(length, 0)), '\0');
  }

  void attribute(hid_t source, hid_t target, const std::string& where) const {
    const Handle type(H5Aget_type(source), H5Tclose), space(H5Aget_space(source), H5Sclose);
    std::vector<char> values = room_for(space, type);
    std::string name = room_for_name(H5Aget_name(source, 0, nullptr));
    H5Aget_name(source, name.size() + 1, name.data());
    require(H5Aread(source, type.id(), values.data()) >= 0, where);
    Handle made(H5Acreate2(target, name.c_str(), type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT),
                H5Aclose);
    require(made.valid() && H5Awrite(made.id(), type.id(), values.data()) >= 0, where);
    require(made.close(), where);
  }

  void attributes(hid_t source, hid_t target, const std::string& where) const {
    H5O_info_t info;
    require(H5Oget_info2(source, &info, H5O_INFO_NUM_ATTRS) >= 0, where);
    for (hsize_t i = 0; i < info.num_attrs; ++i) {
      const Handle one(
          H5Aopen_by_idx(source, ".", H5_INDEX_NAME, H5_ITER_INC, i, H5P_DEFAULT, H5P_DEFAULT),
          H5Aclose);
      require(one.valid(), where);
      attribute(one.id(), target, where);
    }
  }

  void dataset(hid_t source, const std::string& where) const {
    const Handle type(H5Dget_type(source), H5Tclose), space(H5Dget_space(source), H5Sclose);
    std::vector<char> values = room_for(space, type);
    require(H5Dread(source, type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0, where);
    const Handle layout(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    H5Pset_obj_track_times(layout.id(), false);
    Handle made(
        H5Dcreate2(to, where.c_str(), type.id(), space.id(), H5P_DEFAULT, layout.id(), H5P_DEFAULT),
        H5Dclose);
    require(made.valid(), where);
    require(H5Dwrite(made.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0,
            where);
    attributes(source, made.id(), where);
    require(made.close(), where);
  }

  void group(hid_t source, const std::string& where) const {
    const Handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
    H5Pset_create_intermediate_group(links.id(), 1);
    Handle made(H5Gcreate2(to, where.c_str(), links.id(), H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
    require(made.valid(), where);
    attributes(source, made.id(), where);
    H5G_info_t info;
    require(H5Gget_info(source, &info) >= 0, where);
    for (hsize_t i = 0; i < info.nlinks; ++i) {
      const auto name_of = [&](char* name, std::size_t size) {
        return H5Lget_name_by_idx(source, ".", H5_INDEX_NAME, H5_ITER_INC, i, name, size,
                                  H5P_DEFAULT);
      };
      std::string name = room_for_name(name_of(nullptr, 0));
      require(name_of(name.data(), name.size() + 1) > 0, where);
      object(where + "/" + name);
    }
    require(made.close(), where);
  }
};

} // namespace plyform::hdf5
