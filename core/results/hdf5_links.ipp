// SPDX-License-Identifier: GPL-3.0-or-later
// What a results.h5 may refer to outside of itself, for hdf5_reader.cpp: the files of its own
// states while a run is in progress, and nothing else. HDF5 follows links to any file, and takes
// the numbers of a dataset from any file or dataset that it names.
#pragma once

#include "core/results/hdf5_handles.ipp"
#include "core/results/result_fields.hpp"

#include <filesystem>
#include <string>

namespace plyform::hdf5 {

/// The file, from the folder of results.h5, that a group may be in while a run is in progress; as
/// write_linked makes it. Empty: none.
inline std::filesystem::path file_of_group(const std::string& group) {
  if (group == "/plies" || group == "/tools") return constants_file();
  const std::string frames = "/frames/";
  if (!group.starts_with(frames)) return {};
  std::size_t index = 0;
  const char* end = group.data() + group.size();
  const auto [stop, error] = std::from_chars(group.data() + frames.size(), end, index);
  return error == std::errc() && stop == end && frame_group(index) == group
             ? state_file(index)
             : std::filesystem::path();
}

/// Why the link `where`, all before which have been asked about, must not be followed; empty if it
/// may. folder: of results.h5.
inline std::string fault_of_link(hid_t file, const std::string& where,
                                 const std::filesystem::path& folder) {
  H5L_info_t link;
  if (H5Lget_info(file, where.c_str(), &link, H5P_DEFAULT) < 0) return {}; // it is missing
  if (link.type == H5L_TYPE_HARD) return {};
  if (link.type != H5L_TYPE_EXTERNAL) return "is a link to something else";
  std::string value(link.u.val_size + 1, '\0');
  unsigned flags = 0;
  const char *name = nullptr, *object = nullptr;
  if (H5Lget_val(file, where.c_str(), value.data(), value.size(), H5P_DEFAULT) < 0 ||
      H5Lunpack_elink_val(value.data(), link.u.val_size, &flags, &name, &object) < 0)
    return "is a link that cannot be read";
  const std::filesystem::path own = file_of_group(where);
  if (own.empty() || own != name || where != object) return "is a link to another file";
  std::error_code error;
  const auto status = std::filesystem::symlink_status(folder / own, error);
  if (exists(status) && !is_regular_file(status)) return "is a link to what is no file";
  return {};
}

/// Why the numbers of a dataset must not be read; empty if they are in its file.
inline std::string fault_of_storage(hid_t set) {
  const Handle made(H5Dget_create_plist(set), H5Pclose);
  if (!made.valid()) return "cannot be read";
  const H5D_layout_t layout = H5Pget_layout(made.id());
  if (layout != H5D_COMPACT && layout != H5D_CONTIGUOUS && layout != H5D_CHUNKED)
    return "takes its numbers from other datasets";
  return H5Pget_external_count(made.id()) == 0 ? "" : "takes its numbers from another file";
}

} // namespace plyform::hdf5
