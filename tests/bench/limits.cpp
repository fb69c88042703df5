// SPDX-License-Identifier: MIT
#include "bench/limits.hpp"

namespace oiler::bench {

#define OILER_BENCH_DECLARE(isa)              \
    namespace isa {                           \
    extern const HandLoops<float> in_float;   \
    extern const HandLoops<double> in_double; \
    }
OILER_BENCH_DECLARE(sse2)
OILER_BENCH_DECLARE(avx2)
OILER_BENCH_DECLARE(avx512)
#undef OILER_BENCH_DECLARE

std::vector<Limits> supported_limits() {
    std::vector<Limits> all{{"SSE2", &sse2::in_float, &sse2::in_double}};
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
        __builtin_cpu_supports("bmi2"))
        all.push_back({"AVX2", &avx2::in_float, &avx2::in_double});
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
        __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw"))
        all.push_back({"AVX-512", &avx512::in_float, &avx512::in_double});
    return all;
}

}  // namespace oiler::bench
