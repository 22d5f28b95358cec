// SPDX-License-Identifier: GPL-3.0-or-later
// What writing and reading results.h5 share, with HDF5 in it: for hdf5_writer.cpp and
// hdf5_reader.cpp only.
#pragma once

#include "base/format.hpp"
#include "base/geometry.hpp"

#include <charconv>
#include <cstdint>
#include <filesystem>
#include <hdf5.h>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <type_traits>
#include <utility>

namespace plyform::hdf5 {

// Vec3 and Triangle arrays go to and from HDF5 as they lie in memory.
static_assert(sizeof(Vec3) == 3 * sizeof(double) && sizeof(Triangle) == 3 * sizeof(std::int32_t));

/// Keeps HDF5 from printing its error stack; ours goes into the exception.
struct QuietErrors {
  H5E_auto2_t function = nullptr;
  void* data = nullptr;
  QuietErrors() {
    H5Eget_auto2(H5E_DEFAULT, &function, &data);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~QuietErrors() { H5Eset_auto2(H5E_DEFAULT, function, data); }
  QuietErrors(const QuietErrors&) = delete;
  QuietErrors& operator=(const QuietErrors&) = delete;
};

/// The system's message in a text of HDF5 ("..., errno = 28, ..."), which goes on about times and
/// addresses; the text itself if it has none.
inline std::string system_reason(const std::string& text) {
  const std::string_view key = "errno = ";
  const std::size_t at = text.find(key);
  if (at == std::string::npos) return text;
  int number = 0;
  std::from_chars(text.data() + at + key.size(), text.data() + text.size(), number);
  return number > 0 ? std::generic_category().message(number) : text;
}

/// What HDF5's innermost error says; that is where the system's own message stands.
inline std::string reason() {
  std::string found;
  H5Ewalk2(
      H5E_DEFAULT, H5E_WALK_UPWARD,
      [](unsigned, const H5E_error2_t* error, void* text) -> herr_t {
        auto& out = *static_cast<std::string*>(text);
        if (out.empty() && error->desc) out = error->desc;
        return 0;
      },
      &found);
  H5Eclear2(H5E_DEFAULT);
  return found.empty() ? "HDF5 gives no reason" : system_reason(found);
}

[[noreturn]] inline void fail(const std::filesystem::path& path, const std::string& what) {
  throw std::runtime_error(fmt::format("{}: {}: {}", path.string(), what, reason()));
}

/// Owns an HDF5 identifier.
class Handle {
public:
  using Closer = herr_t (*)(hid_t);
  Handle() = default;
  Handle(hid_t id, Closer closer) : id_(id), closer_(closer) {}
  Handle(Handle&& other) noexcept { *this = std::move(other); }
  Handle& operator=(Handle&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(closer_, other.closer_);
    return *this;
  }
  ~Handle() { close(); }
  bool close() {
    const bool ok = id_ < 0 || closer_(id_) >= 0;
    id_ = H5I_INVALID_HID;
    return ok;
  }
  hid_t id() const { return id_; }
  bool valid() const { return id_ >= 0; }

private:
  hid_t id_ = H5I_INVALID_HID;
  Closer closer_ = nullptr;
};

template <class T>
hid_t memory_type() {
  if constexpr (std::is_same_v<T, double> || std::is_same_v<T, Vec3>)
    return H5T_NATIVE_DOUBLE;
  else if constexpr (std::is_same_v<T, Triangle>)
    return H5T_NATIVE_INT32;
  else
    return H5T_NATIVE_INT64;
}

template <class T>
hid_t file_type() {
  if constexpr (std::is_same_v<T, double> || std::is_same_v<T, Vec3>)
    return H5T_IEEE_F64LE;
  else if constexpr (std::is_same_v<T, Triangle>)
    return H5T_STD_I32LE;
  else
    return H5T_STD_I64LE;
}

/// Columns of a dataset whose rows are T.
template <class T>
constexpr hsize_t columns = std::is_same_v<T, Vec3> || std::is_same_v<T, Triangle> ? 3 : 1;

/// Of the layout that docs/users/results.md describes.
constexpr std::int64_t layout_version = 3;

/// Strings of `length` bytes, shorter ones filled up with zeros.
inline Handle utf8_type(std::size_t length) {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type.id(), length);
  H5Tset_strpad(type.id(), H5T_STR_NULLPAD);
  H5Tset_cset(type.id(), H5T_CSET_UTF8);
  return type;
}

} // namespace plyform::hdf5
