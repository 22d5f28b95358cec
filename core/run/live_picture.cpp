// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/run/live_picture.hpp"

#include "base/write_whole.hpp"

#include <bit>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <system_error>

namespace plyform {
namespace {

using Json = nlohmann::ordered_json;
constexpr auto between_looks = std::chrono::milliseconds(250);
constexpr int times_apart = 20; // what a picture takes, so that the run is not held up

void append_number(std::string& bytes, std::uint32_t number) {
  for (int shift = 0; shift < 32; shift += 8)
    bytes += static_cast<char>((number >> shift) & 0xff);
}

Json array_from(std::size_t at, const std::string& bytes, const char* type) {
  return {{"at", at}, {"count", (bytes.size() - at) / 4}, {"type", type}};
}

/// Appends an array of single precision, and returns what stands for it in the header.
template <class Values>
Json append(std::string& bytes, const Values& values) {
  const std::size_t at = bytes.size();
  for (const double value : values)
    append_number(bytes, std::bit_cast<std::uint32_t>(static_cast<float>(value)));
  return array_from(at, bytes, "f4");
}

Json append(std::string& bytes, const std::vector<Triangle>& triangles) {
  const std::size_t at = bytes.size();
  for (const Triangle& triangle : triangles)
    for (const int node : triangle)
      append_number(bytes, static_cast<std::uint32_t>(node));
  return array_from(at, bytes, "u4");
}

std::vector<double> numbers_of(const std::vector<Vec3>& places) {
  std::vector<double> numbers;
  numbers.reserve(3 * places.size());
  for (const Vec3& place : places)
    numbers.insert(numbers.end(), {place.x(), place.y(), place.z()});
  return numbers;
}

} // namespace

std::string picture_of(const Frame& frame, int scouting) {
  std::string arrays;
  Json header{{"step", frame.step}, {"time_s", frame.time}, {"stroke_mm", frame.stroke_mm}};
  if (scouting > 0) header["scouting"] = scouting;
  header["plies"] = Json::array();
  for (const PlyFrame& ply : frame.plies) {
    Json one{{"name", ply.name}};
    one["x"] = append(arrays, numbers_of(ply.x));
    one["field"] = append(arrays, ply.shear_deg);
    if (scouting > 0) {
      one["x0"] = append(arrays, numbers_of(ply.x0));
      one["triangles"] = append(arrays, ply.triangles);
    }
    header["plies"].push_back(std::move(one));
  }
  header["tools"] = Json::array();
  for (const ToolFrame& tool : frame.tools) {
    const Vec3& shift = tool.displacement;
    Json one{{"name", tool.name}, {"shift", {shift.x(), shift.y(), shift.z()}}};
    if (scouting > 0 && !tool.surface.triangles.empty()) {
      one["x"] = append(arrays, numbers_of(tool.surface.x));
      one["triangles"] = append(arrays, tool.surface.triangles);
    }
    header["tools"].push_back(std::move(one));
  }
  const std::string text = header.dump(-1, ' ', false, Json::error_handler_t::replace);
  std::string bytes;
  append_number(bytes, static_cast<std::uint32_t>(text.size()));
  return bytes + text + std::string((4 - text.size() % 4) % 4, '\0') + arrays;
}

LivePicture::LivePicture(const std::filesystem::path& folder)
    : ask_(folder / "picture.ask"), picture_(folder / "picture.bin") {
  std::error_code ignored; // of a run that was killed
  std::filesystem::remove(picture_, ignored);
}

LivePicture::~LivePicture() {
  std::error_code ignored;
  std::filesystem::remove(ask_, ignored);
  std::filesystem::remove(picture_, ignored);
}

bool LivePicture::asked() {
  begin_ = Clock::now();
  if (begin_ < next_) return false;
  next_ = begin_ + between_looks;
  std::error_code ignored;
  return std::filesystem::remove(ask_, ignored);
}

void LivePicture::draw(const Frame& frame, int scouting) {
  write_if_possible(picture_, picture_of(frame, scouting));
  const auto end = Clock::now();
  next_ = std::max(next_, end + times_apart * (end - begin_));
}

} // namespace plyform
