// SPDX-License-Identifier: GPL-3.0-or-later
// A folder of results whose results.h5 is anything: `plyform export` refuses it with
// std::runtime_error, or writes finite numbers. HDF5 reads it in a process of its own, which may
// end as it likes; but AddressSanitizer, which ends it without a message, must find nothing there.
#include "core/results/export.hpp"
#include "fuzz/fuzz_file.hpp"
#include "fuzz/shared_counters.hpp"

#include <stdexcept>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace plyform;
  static const bool shared = fuzz::share_counters();
  (void)shared;
  fuzz::put("results.h5", data, size);
  try {
    for (const auto& file : export_results(fuzz::folder())) {
      if (file.extension() != ".csv") continue;
      std::ifstream in(file);
      for (std::string row; std::getline(in, row);)
        if (row.find("nan") != std::string::npos || row.find("inf") != std::string::npos)
          std::abort();
    }
  } catch (const std::runtime_error& refused) {
    if (*refused.what() == '\0') std::abort();
  }
  return 0;
}
