// SPDX-License-Identifier: GPL-3.0-or-later
// Saves a state to bytes and loads it again, bit by bit, on the same machine and by the same build:
// for checkpoints, not for exchange. What is saved of a type is listed once, for all directions, so
// that what is saved and what is loaded cannot differ: by a function
//
//   template <class F> void each_member(Type& object, F&& f) { f("name", object.name); ... }
//
// beside the type, or by an overload of `visit`. The same lists compare a state with a saved one
// and name the first member that differs, and hash it. Types with padding need a list: their bytes
// are not their value.
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

/// Reads as LoadArchive, but compares what it is called with, and changes nothing.
class CompareArchive {
public:
  static constexpr bool loads = false;
  explicit CompareArchive(std::string_view text) : left_(text) {}
  void bytes(void* data, std::size_t size) {
    if (differs()) return; // from there on sizes may differ, too
    if (size > left_.size() || (size > 0 && std::memcmp(data, left_.data(), size) != 0))
      first_difference_ = path_.empty() ? "." : path_;
    left_.remove_prefix(std::min(size, left_.size()));
  }
  void enter(std::string_view name) {
    ends_.push_back(path_.size());
    path_.append(path_.empty() ? "" : ".").append(name);
  }
  void leave() {
    path_.resize(ends_.back());
    ends_.pop_back();
  }
  bool differs() const { return !first_difference_.empty(); }
  /// As "plies.0.velocity"; empty if nothing differs.
  const std::string& first_difference() const { return first_difference_; }

private:
  std::string_view left_;
  std::string path_, first_difference_;
  std::vector<std::size_t> ends_; ///< of the paths entered
};

/// Hash (FNV-1a) of the bytes of what it is called with.
class HashArchive {
public:
  static constexpr bool loads = false;
  void bytes(void* data, std::size_t size) {
    for (const char c : std::string_view(static_cast<const char*>(data), size))
      hash_ = (hash_ ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
  }
  std::uint64_t hash() const { return hash_; }

private:
  std::uint64_t hash_ = 14695981039346656037ULL;
};

/// Types whose bytes are their value. Eigen's vectors of fixed size are, though the language does
/// not call them trivially copyable.
template <class T>
constexpr bool is_plain = std::is_trivially_copyable_v<T> && !std::is_pointer_v<T>;
template <>
inline constexpr bool is_plain<Eigen::Vector3d> = true;

/// Types with a list of what is saved of them.
template <class T>
concept Listed = requires(T& object) {
  each_member(object, [](const char*, auto&&) {});
};

/// An array whose number of elements is given by what the state is of, not by the archive.
template <class T>
struct FixedSize {
  std::vector<T>& values;
};
template <class T>
FixedSize<T> of_fixed_size(std::vector<T>& values) {
  return {values};
}

template <class Archive, class T>
requires(is_plain<T> && !Listed<T>) void visit(Archive& archive, T& value) {
  archive.bytes(&value, sizeof(T));
}

/// A byte that is neither 0 nor 1 is no truth value, and must not become one.
template <class Archive>
void visit(Archive& archive, bool& value) {
  unsigned char byte = value ? 1 : 0;
  archive.bytes(&byte, 1);
  if (byte > 1) throw std::runtime_error("holds a truth value that is none");
  if constexpr (Archive::loads) value = byte == 1;
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

/// A part of what is visited, for archives that tell where they are.
template <class Archive, class Name, class T>
void visit_part(Archive& archive, const Name& name, T& part) {
  if constexpr (requires { archive.enter(std::string_view()); }) {
    if constexpr (std::is_integral_v<Name>)
      archive.enter(std::to_string(name));
    else
      archive.enter(name);
    visit(archive, part);
    archive.leave();
  } else {
    visit(archive, part);
  }
}

template <class Archive, class T>
void visit(Archive& archive, std::vector<T>& values) {
  if constexpr (is_plain<T> && !Listed<T>) {
    visit_size(archive, values, sizeof(T));
    archive.bytes(values.data(), values.size() * sizeof(T));
  } else {
    visit_size(archive, values, 1);
    for (std::size_t i = 0; i < values.size(); ++i)
      visit_part(archive, i, values[i]);
  }
}

template <class Archive, class T>
void visit(Archive& archive, FixedSize<T>& array) {
  auto size = static_cast<std::uint64_t>(array.values.size());
  visit(archive, size);
  if (size != array.values.size()) throw std::runtime_error("is of another scene");
  for (std::size_t i = 0; i < array.values.size(); ++i)
    visit_part(archive, i, array.values[i]);
}

template <class Archive, Listed T>
void visit(Archive& archive, T& object) {
  each_member(object, [&](const char* name, auto&& member) { visit_part(archive, name, member); });
}

template <class Archive, class... T>
requires(sizeof...(T) > 1) void visit(Archive& archive, T&... values) {
  (visit(archive, values), ...);
}

} // namespace plyform
