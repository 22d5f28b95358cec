// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/names.hpp"

#include "base/format.hpp"
#include "base/words.hpp"

namespace plyform {

std::string fault_of_name(std::string_view name) {
  if (name.empty()) return "must not be empty";
  if (name.size() > longest_name)
    return fmt::format("must not be longer than {} bytes, and has {}", longest_name, name.size());
  if (printable(name) != name)
    return "must not hold control characters, or others that nobody sees";
  if (name.find_first_of("/\\") != std::string_view::npos) return "must not hold / or \\";
  if (name == "." || name == "..") return "must not be . or .., which are folders";
  return {};
}

std::string fault_of_file_name(std::string_view name) {
  if (std::string fault = fault_of_name(name); !fault.empty()) return fault;
  if (name.front() == '.') return "must not begin with a dot";
  if (name.find_first_of(":*?\"<>|") != std::string_view::npos)
    return "must not hold any of : * ? \" < > |";
  return {};
}

} // namespace plyform
