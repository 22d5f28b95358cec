// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/results/field_difference.hpp"
#include "core/results/result_fields.hpp"
#include "tools/cli/commands.hpp"

#include <filesystem>
#include <fmt/format.h>

namespace plyform {

int difference_command(const DifferenceArguments& arguments) {
  const std::filesystem::path run = arguments.run, reference = arguments.reference;
  const Frame last = read_last_frame(run / "results.h5");
  const Frame wanted = read_last_frame(reference / "results.h5");
  fmt::print("field,rms,p95,p99,max,mean\n");
  for (const std::string& field : arguments.fields) {
    const FieldError e = field_difference(last, wanted, field).error;
    fmt::print("{},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g}\n", field, e.rms, e.p95, e.p99, e.max,
               e.mean);
  }
  return exit_done;
}

} // namespace plyform
