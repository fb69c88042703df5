/* SPDX-License-Identifier: MIT */
#include <stdio.h>

/* Prints the widest instruction set of this machine that has kernels. */
int main(void) {
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
        __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl"))
        fputs("avx512", stdout);
    else
        fputs(__builtin_cpu_supports("avx2") ? "avx2" : "baseline", stdout);
    return 0;
}
