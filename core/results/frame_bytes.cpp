// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/results/frame_bytes.hpp"

#include <cstring>
#include <stdexcept>
#include <type_traits>

namespace plyform {
namespace {

/// Appends values to bytes.
struct Sink {
  std::string bytes;

  template <class T>
  void plain(const T* values, std::size_t count) {
    bytes.append(reinterpret_cast<const char*>(values), count * sizeof(T));
  }
  template <class T>
  void operator()(const T& value) {
    static_assert(std::is_arithmetic_v<T> || std::is_same_v<T, Vec3>);
    plain(&value, 1);
  }
  template <class List>
  void size(const List& list) {
    const std::size_t count = list.size();
    plain(&count, 1);
  }
  void operator()(const std::string& text) {
    size(text);
    plain(text.data(), text.size());
  }
  template <class T>
  void list(const std::vector<T>& values) {
    size(values);
    plain(values.data(), values.size());
  }
};

/// Takes values from bytes.
struct Source {
  std::string_view bytes;

  template <class T>
  void plain(T* values, std::size_t count) {
    if (count > bytes.size() / sizeof(T)) throw std::runtime_error("a frame's bytes are cut short");
    if (count > 0) std::memcpy(values, bytes.data(), count * sizeof(T));
    bytes.remove_prefix(count * sizeof(T));
  }
  template <class T>
  void operator()(T& value) {
    static_assert(std::is_arithmetic_v<T> || std::is_same_v<T, Vec3>);
    if constexpr (std::is_same_v<T, Vec3>)
      plain(value.data(), 3);
    else
      plain(&value, 1);
  }
  template <class List>
  std::size_t size(List& list) {
    std::size_t count = 0;
    plain(&count, 1);
    if (count > bytes.size()) throw std::runtime_error("a frame's bytes are cut short");
    list.resize(count);
    return count;
  }
  void operator()(std::string& text) {
    const std::size_t count = size(text);
    plain(text.data(), count);
  }
  template <class T>
  void list(std::vector<T>& values) {
    std::size_t count = 0;
    plain(&count, 1);
    if (count > bytes.size() / sizeof(T)) throw std::runtime_error("a frame's bytes are cut short");
    values.resize(count);
    if (count > 0) std::memcpy(static_cast<void*>(values.data()), bytes.data(), count * sizeof(T));
    bytes.remove_prefix(count * sizeof(T));
  }
};

// Each part with all that results.h5 has of it, to a sink or from a source.

template <class To, class Item>
void pass_ply(To& to, Item& ply) {
  to(ply.name), to(ply.angle_deg);
  to.list(ply.x0), to.list(ply.x), to.list(ply.triangles);
  for (const auto& field : cell_vectors)
    to.list(ply.*field.values);
  for (const auto& field : cell_scalars)
    to.list(ply.*field.values);
  for (const auto& field : node_scalars)
    to.list(ply.*field.values);
  for (const auto& field : node_vectors)
    to.list(ply.*field.values);
}

template <class To, class Item>
void pass_tool(To& to, Item& tool) {
  to(tool.name), to.list(tool.surface.x), to.list(tool.surface.triangles);
  to(tool.displacement), to(tool.force), to(tool.stroke_mm), to(tool.force_N);
}

template <class To, class Item>
void pass_frame(To& to, Item& frame) {
  to(frame.time), to(frame.stroke_mm), to(frame.step);
  to.size(frame.plies);
  for (auto& ply : frame.plies)
    pass_ply(to, ply);
  to.size(frame.tools);
  for (auto& tool : frame.tools)
    pass_tool(to, tool);
  to.size(frame.boundaries);
  for (auto& boundary : frame.boundaries)
    to(boundary.name), to(boundary.force), to(boundary.stroke_mm), to(boundary.force_N);
}

} // namespace

std::string frame_to_bytes(const Frame& frame) {
  Sink sink;
  pass_frame(sink, frame);
  return std::move(sink.bytes);
}

Frame frame_from_bytes(std::string_view bytes) {
  Source source{bytes};
  Frame frame;
  pass_frame(source, frame);
  if (!source.bytes.empty()) throw std::runtime_error("bytes follow a frame's");
  return frame;
}

} // namespace plyform
