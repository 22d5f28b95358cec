// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/format.hpp"
#include "core/results/field_difference.hpp"
#include "core/results/result_fields.hpp"
#include "tools/cli/commands.hpp"

#include <filesystem>

namespace plyform {
namespace {

/// A cell of CSV; in quotes with a comma (names hold no quotes).
std::string cell_text(const std::string& text) {
  return text.find(',') == std::string::npos ? text : "\"" + text + "\"";
}

} // namespace

int difference_command(const DifferenceArguments& arguments) {
  const std::filesystem::path run = arguments.run, reference = arguments.reference;
  const Frame last = read_last_frame(run / "results.h5");
  const Frame wanted = read_last_frame(reference / "results.h5");
  const auto say = [](const std::string& what, const FieldError& e) {
    fmt::print("{},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g}\n", what, e.rms, e.p95, e.p99, e.max, e.mean);
  };
  fmt::print("field{},rms,p95,p99,max,mean\n", arguments.by_ply ? ",ply" : "");
  for (const std::string& field : arguments.fields) {
    const FieldError all = field_difference(last, wanted, field).error; // also checks the plies
    if (!arguments.by_ply) {
      say(field, all);
      continue;
    }
    for (std::size_t p = 0; p < wanted.plies.size(); ++p)
      say(field + "," + cell_text(wanted.plies[p].name),
          field_difference(only_ply(last, p), only_ply(wanted, p), field).error);
  }
  return exit_done;
}

} // namespace plyform
