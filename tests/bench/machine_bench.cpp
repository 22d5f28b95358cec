// SPDX-License-Identifier: GPL-3.0-or-later
// Bandwidth and arithmetic of one core.
#include "base/cpu_features.hpp"
#include "tests/bench/machine.hpp"
#include "tests/bench/machine_kernel.hpp"

#include <algorithm>
#include <benchmark/benchmark.h>
#include <cstdint>
#include <ctime>
#include <fstream>
#include <map>
#include <string>
#include <vector>

namespace plyform {
namespace {

/// Name of the processor (Linux), to stand with the results.
std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    const std::size_t colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown processor";
}

[[maybe_unused]] const bool named =
    (benchmark::AddCustomContext("processor", processor_name()), true);

double clock_seconds(clockid_t clock) {
  timespec t{};
  clock_gettime(clock, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

double thread_seconds() {
  return clock_seconds(CLOCK_THREAD_CPUTIME_ID);
}

/// Three arrays in one piece of memory, not a multiple of 4096 bytes apart: a processor that
/// compares only the low bits of addresses would take reads for reads of what is being written.
struct Arrays {
  explicit Arrays(double bytes) {
    count = std::max<std::size_t>(static_cast<std::size_t>(bytes) / 24 / 8 * 8, 8);
    constexpr std::size_t apart = 40, line = 8; // doubles
    const std::size_t pitch = (count + 511) / 512 * 512 + apart;
    memory.assign(3 * pitch + line, 1.0);
    const auto address = reinterpret_cast<std::uintptr_t>(memory.data());
    a = memory.data() + (64 - address % 64) % 64 / sizeof(double);
    b = a + pitch, c = b + pitch;
  }
  std::vector<double> memory;
  double *a, *b, *c;
  std::size_t count;
};

double measure_bandwidth(double bytes) {
  const auto triad = fastest(triad_generic, triad_avx2);
  Arrays arrays(bytes);
  const double pass = 24.0 * static_cast<double>(arrays.count);
  const int passes = static_cast<int>(std::max(1.0, 4e7 / pass)); // some milliseconds
  double best = 0.0, spent = 0.0;
  for (int i = 0; i < 100 && (spent < 0.3 || i < 5); ++i) {
    const double begin = thread_seconds();
    for (int k = 0; k < passes; ++k) {
      triad(arrays.a, arrays.b, arrays.c, 0.5, arrays.count);
      benchmark::ClobberMemory();
    }
    const double seconds = thread_seconds() - begin;
    if (i > 0) best = std::max(best, passes * pass / seconds);
    spent += seconds;
  }
  return best;
}

double measure_arithmetic() {
  const auto chains = fastest(chains_generic, chains_avx2);
  double best = 0.0, spent = 0.0;
  while (spent < 0.5) { // long enough to find a moment when nobody else shares the core
    alignas(32) double at[4] = {1.0, 2.0, 3.0, 4.0};
    const double begin = thread_seconds();
    const double operations = chains(at, 1000000);
    const double seconds = thread_seconds() - begin;
    best = std::max(best, operations / seconds);
    spent += seconds;
    benchmark::DoNotOptimize(at);
  }
  return best;
}

/// Range 0: kB of the working set: within the first, second and third cache of most processors,
/// and beyond them.
void Bandwidth(benchmark::State& state) {
  double found = 0.0;
  for (auto _ : state)
    found = stream_bandwidth(1024.0 * static_cast<double>(state.range(0)));
  state.counters["GB_s"] = 1e-9 * found;
}
BENCHMARK(Bandwidth)->Arg(16)->Arg(256)->Arg(8192)->Arg(262144)->Iterations(1);

void Arithmetic(benchmark::State& state) {
  double found = 0.0;
  for (auto _ : state)
    found = peak_arithmetic();
  state.counters["Gflop_s"] = 1e-9 * found;
  state.SetLabel(has_avx2() ? "AVX2" : "any processor");
}
BENCHMARK(Arithmetic)->Iterations(1);

} // namespace

double cpu_seconds() {
  return clock_seconds(CLOCK_PROCESS_CPUTIME_ID);
}

double stream_bandwidth(double bytes) {
  constexpr double most = 262144.0 * 1024.0;
  static std::map<double, double> known;
  const double set = std::min(bytes, most);
  const auto at = known.find(set);
  return at != known.end() ? at->second : known[set] = measure_bandwidth(set);
}

double peak_arithmetic() {
  static const double found = measure_arithmetic();
  return found;
}

} // namespace plyform
