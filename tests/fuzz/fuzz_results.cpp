// SPDX-License-Identifier: GPL-3.0-or-later
// A folder of results whose results.h5 is anything: `plyform export` refuses it with
// std::runtime_error, or writes finite numbers. HDF5 reads it in a process of its own, which may
// end as it likes; but AddressSanitizer, which ends it without a message, must find nothing there.
#include "core/results/export.hpp"
#include "fuzz/fuzz_file.hpp"

#include <cstring>
#include <new>
#include <stdexcept>
#include <sys/mman.h>

// How often each place of the code was passed, from which libFuzzer learns: clang's section, under
// names that the linker gives it (CMakeLists.txt); none in the test that replays the corpus.
extern "C" __attribute__((weak)) std::uint8_t counters_begin[];
extern "C" __attribute__((weak)) std::uint8_t counters_end[];

namespace {

/// Has the counters in memory that the process which reads shares with this one.
bool share_counters() {
  const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
  const auto begin = reinterpret_cast<std::uintptr_t>(counters_begin) + page - 1;
  const auto end = reinterpret_cast<std::uintptr_t>(counters_end);
  if (end < begin + page) return false;
  auto* const first = reinterpret_cast<std::uint8_t*>(begin / page * page);
  const std::size_t bytes = (end / page - begin / page) * page;
  const std::string now(first, first + bytes);
  if (mmap(first, bytes, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS | MAP_FIXED, -1, 0) ==
      MAP_FAILED)
    throw std::bad_alloc();
  std::memcpy(first, now.data(), bytes);
  return true;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace plyform;
  static const bool shared = share_counters();
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
