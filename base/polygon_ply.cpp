// SPDX-License-Identifier: GPL-3.0-or-later
// PLY, as text or binary in either order of bytes. A header names elements (vertex, face) with
// their count, and the properties of each: numbers, or lists of numbers with their length before
// them. x, y and z of vertices and the list of corners of faces are used.
#include "base/polygon_text.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

namespace plyform {
namespace {

struct NumberType {
  std::size_t bytes = 0;
  bool real = false, is_signed = false;
};

struct Property {
  std::string name;
  NumberType type;
  NumberType length{}; ///< of the list's length; 0 bytes: a number, not a list
  bool list() const { return length.bytes > 0; }
};

struct Element {
  std::string name;
  std::size_t count = 0;
  std::vector<Property> properties;
};

struct Header {
  enum class Format { text, little, big } format = Format::text;
  std::vector<Element> elements;
};

NumberType type_named(const WordReader& in, std::string_view word) {
  if (word == "char" || word == "int8") return {1, false, true};
  if (word == "uchar" || word == "uint8") return {1, false, false};
  if (word == "short" || word == "int16") return {2, false, true};
  if (word == "ushort" || word == "uint16") return {2, false, false};
  if (word == "int" || word == "int32") return {4, false, true};
  if (word == "uint" || word == "uint32") return {4, false, false};
  if (word == "float" || word == "float32") return {4, true, true};
  if (word == "double" || word == "float64") return {8, true, true};
  in.fail(fmt::format("the header has a property of type '{}', which PLY does not know; export the "
                      "mesh again",
                      shown(word, 30)));
}

Property property_of(WordReader& in) {
  Property property;
  std::string_view word = in.word_of_line();
  if (word == "list") {
    property.length = type_named(in, in.word_of_line());
    if (property.length.real) in.fail("a list has a length that is no whole number; export again");
    word = in.word_of_line();
  }
  property.type = type_named(in, word);
  property.name = in.word_of_line();
  if (property.name.empty()) in.fail("a property has no name; export the mesh again");
  return property;
}

Header::Format format_of(WordReader& in) {
  const std::string_view word = in.word_of_line();
  if (word == "ascii") return Header::Format::text;
  if (word == "binary_little_endian") return Header::Format::little;
  if (word == "binary_big_endian") return Header::Format::big;
  in.fail(fmt::format("the format is '{}', not ascii, binary_little_endian or binary_big_endian; "
                      "export the mesh again",
                      shown(word, 30)));
}

/// Reads the header up to the end of its last line.
Header read_header(WordReader& in) {
  if (in.word() != "ply")
    in.fail("no faces could be read as ply: it does not begin with ply; export the surface again");
  Header header;
  bool format = false;
  for (;;) {
    const std::string_view word = in.word();
    if (word == "format") {
      header.format = format_of(in);
      format = true;
    } else if (word == "element") {
      Element& element = header.elements.emplace_back();
      element.name = in.word_of_line();
      element.count = in.count(in.word_of_line(), "the count of an element", 1);
    } else if (word == "property") {
      if (header.elements.empty())
        in.fail("the header has a property before any element; export the mesh again");
      header.elements.back().properties.push_back(property_of(in));
    } else if (word == "end_header") {
      if (!format) in.fail("the header names no format; export the mesh again");
      in.skip_line();
      return header;
    } else if (word != "comment" && word != "obj_info") {
      if (word.empty()) in.fail("the file is truncated: its header has no end; copy it again");
      in.fail(
          fmt::format("'{}' is no line of a PLY header; export the mesh again", shown(word, 30)));
    }
    in.skip_line();
  }
}

/// Numbers of the body, one after the other.
class Body {
public:
  Body(Header::Format format, std::string_view bytes)
      : format_(format), bytes_(bytes), words_(bytes) {}

  double number(const NumberType& type) {
    if (format_ == Header::Format::text) return words_.coordinate(words_.word());
    return type.real ? real(type) : static_cast<double>(whole(type));
  }
  std::int64_t integer(const NumberType& type) {
    if (format_ == Header::Format::text)
      return words_.integer(words_.word(), "the number or count of corners");
    return whole(type);
  }
  void skip(const NumberType& type) {
    if (format_ != Header::Format::text)
      take(type.bytes);
    else if (words_.word().empty())
      words_.coordinate({}); // throws
  }
  /// Throws if a list of that length cannot be in the rest.
  std::size_t length(const Property& property) {
    const std::int64_t count = integer(property.length);
    const std::size_t rest = format_ == Header::Format::text
                                 ? (bytes_.size() - words_.position()) / 2 + 1
                                 : (bytes_.size() - at_) / property.type.bytes;
    if (count < 0 || static_cast<std::uint64_t>(count) > rest)
      throw std::runtime_error(fmt::format(
          "a list has {} entries, more than the rest of the file can hold: it is truncated, or the "
          "number wrong; export or copy it again",
          count));
    return static_cast<std::size_t>(count);
  }
  void expect_end() {
    if (format_ == Header::Format::text)
      words_.expect_end("the elements that its header counts");
    else if (bytes_.find_first_not_of(" \t\r\n", at_) != bytes_.npos)
      throw std::runtime_error("the file goes on after the elements that its header counts; "
                               "correct the counts, or export the mesh again");
  }

private:
  const char* take(std::size_t count) {
    if (bytes_.size() - at_ < count)
      throw std::runtime_error("the file is truncated: it has less than its header promises; "
                               "export or copy it again");
    at_ += count;
    return bytes_.data() + at_ - count;
  }
  /// The next bytes as an unsigned number.
  std::uint64_t bits(std::size_t count) {
    const char* from = take(count);
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t place = format_ == Header::Format::little ? count - 1 - i : i;
      value = (value << 8) | static_cast<unsigned char>(from[place]);
    }
    return value;
  }
  double real(const NumberType& type) {
    const std::uint64_t value = bits(type.bytes);
    if (type.bytes == 8) return std::bit_cast<double>(value);
    return static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(value)));
  }
  std::int64_t whole(const NumberType& type) {
    if (type.real) return static_cast<std::int64_t>(real(type));
    const std::uint64_t value = bits(type.bytes);
    const std::uint64_t sign = std::uint64_t{1} << (8 * type.bytes - 1);
    if (!type.is_signed || (value & sign) == 0) return static_cast<std::int64_t>(value);
    return static_cast<std::int64_t>(value) - static_cast<std::int64_t>(2 * sign);
  }

  Header::Format format_;
  std::string_view bytes_;
  WordReader words_;
  std::size_t at_ = 0; ///< of binary bodies
};

void read_vertices(const Element& element, Body& body, PolygonSoup& soup) {
  for (const char* axis : {"x", "y", "z"})
    if (std::count_if(element.properties.begin(), element.properties.end(),
                      [&](const auto& p) { return p.name == axis && !p.list(); }) != 1)
      throw std::runtime_error(
          fmt::format("its vertices have no single number {}; export the mesh again", axis));
  for (std::size_t i = 0; i < element.count; ++i) {
    Vec3 p = Vec3::Zero();
    for (const Property& property : element.properties) {
      const bool axis = property.name == "x" || property.name == "y" || property.name == "z";
      if (axis && !property.list()) {
        p[property.name[0] - 'x'] = body.number(property.type);
        continue;
      }
      const std::size_t count = property.list() ? body.length(property) : 1;
      for (std::size_t k = 0; k < count; ++k)
        body.skip(property.type);
    }
    if (!p.allFinite()) throw std::runtime_error(fmt::format("vertex {}: {}", i, not_finite));
    soup.points.push_back(p);
  }
}

/// Reads faces, or skips an element of another name. points: how many there are in the file.
void read_faces(const Element& element, std::size_t points, Body& body, PolygonSoup& soup) {
  const bool faces = element.name == "face";
  const auto corners = [&](const Property& p) {
    return faces && p.list() && !p.type.real &&
           (p.name == "vertex_indices" || p.name == "vertex_index");
  };
  if (faces && std::count_if(element.properties.begin(), element.properties.end(), corners) != 1)
    throw std::runtime_error("its faces have no list vertex_indices of whole numbers; export the "
                             "surface as triangles");
  if (element.properties.empty()) return;
  for (std::size_t i = 0; i < element.count; ++i) {
    if (faces) soup.polygons.emplace_back();
    for (const Property& property : element.properties) {
      const std::size_t count = property.list() ? body.length(property) : 1;
      for (std::size_t k = 0; k < count; ++k) {
        if (!corners(property)) {
          body.skip(property.type);
          continue;
        }
        const std::int64_t number = body.integer(property.type);
        if (number < 0 || static_cast<std::uint64_t>(number) >= points)
          throw std::runtime_error(fmt::format(
              "face {} names point {}, but there are only {}, from 0; export the mesh again", i,
              number, points));
        soup.polygons.back().push_back(static_cast<std::size_t>(number));
      }
    }
  }
}

} // namespace

PolygonSoup parse_ply(std::string_view bytes) {
  WordReader in(bytes);
  const Header header = read_header(in);
  const std::size_t end = in.position();
  if (end >= bytes.size())
    throw std::runtime_error("no faces could be read as ply: the file ends with its header; export "
                             "or copy it again");
  std::size_t points = 0;
  for (const Element& element : header.elements)
    if (element.name == "vertex") points += element.count;
  Body body(header.format, bytes.substr(end + 1));
  PolygonSoup soup;
  for (const Element& element : header.elements) {
    if (element.name == "vertex")
      read_vertices(element, body, soup);
    else
      read_faces(element, points, body, soup);
  }
  body.expect_end();
  return soup;
}

} // namespace plyform
