// SPDX-License-Identifier: GPL-3.0-or-later
// Saves a state to bytes and loads it again, bit by bit, on the same machine and by the same build:
// for checkpoints, not for exchange. One function `visit` per type lists its members for both
// directions, so that what is saved and what is loaded cannot differ.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace plyform {

/// Appends the bytes of what it is called with.
class SaveArchive {
public:
  static constexpr bool loads = false;
  void bytes(void* data, std::size_t size) { out_.append(static_cast<const char*>(data), size); }
  const std::string& text() const { return out_; }

private:
  std::string out_;
};

/// Overwrites what it is called with by the bytes of a SaveArchive, in the same order. Throws
/// std::runtime_error when they come to an end too early.
class LoadArchive {
public:
  static constexpr bool loads = true;
  explicit LoadArchive(std::string_view text) : left_(text) {}
  void bytes(void* data, std::size_t size) {
    if (size > left_.size()) throw std::runtime_error("ends too early");
    if (size > 0) std::memcpy(data, left_.data(), size);
    left_.remove_prefix(size);
  }
  std::size_t left() const { return left_.size(); }

private:
  std::string_view left_;
};

/// Types whose bytes are their value. Eigen's vectors of fixed size are, though the language does
/// not call them trivially copyable.
template <class T>
constexpr bool is_plain = std::is_trivially_copyable_v<T> && !std::is_pointer_v<T>;
template <>
inline constexpr bool is_plain<Eigen::Vector3d> = true;

template <class Archive, class T>
requires is_plain<T>
void visit(Archive& archive, T& value) {
  archive.bytes(&value, sizeof(T));
}

/// A byte that is neither 0 nor 1 is no truth value, and must not become one.
template <class Archive>
void visit(Archive& archive, bool& value) {
  unsigned char byte = value ? 1 : 0;
  archive.bytes(&byte, 1);
  if (byte > 1) throw std::runtime_error("holds a truth value that is none");
  value = byte == 1;
}

/// The number of values, `values` resized to it. One beyond what is left is refused before memory
/// is taken for it.
template <class Archive, class Container>
void visit_size(Archive& archive, Container& values, std::size_t least_bytes) {
  auto size = static_cast<std::uint64_t>(values.size());
  visit(archive, size);
  if constexpr (Archive::loads) {
    if (size > archive.left() / least_bytes) throw std::runtime_error("ends too early");
    values.resize(size);
  }
}

template <class Archive>
void visit(Archive& archive, std::string& text) {
  visit_size(archive, text, 1);
  archive.bytes(text.data(), text.size());
}

template <class Archive, class T>
void visit(Archive& archive, std::vector<T>& values) {
  if constexpr (is_plain<T>) {
    visit_size(archive, values, sizeof(T));
    archive.bytes(values.data(), values.size() * sizeof(T));
  } else {
    visit_size(archive, values, 1);
    for (T& value : values)
      visit(archive, value);
  }
}

template <class Archive, class... T>
requires(sizeof...(T) > 1) void visit(Archive& archive, T&... values) {
  (visit(archive, values), ...);
}

} // namespace plyform
