#pragma once

/// Compiles a function for wider registers as well and picks the version for the machine at run
/// time. Loops whose every element is computed on its own, in files built with -ffp-contract=off,
/// give the same bits in every version. (Clang 22 and the sanitizers, which cannot resolve clones
/// early enough, get one version.)
#if defined(__x86_64__) && !defined(__clang__) && !defined(__SANITIZE_THREAD__) && \
    !defined(__SANITIZE_ADDRESS__)
#define RAKS_SIMD_CLONES __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define RAKS_SIMD_CLONES
#endif
