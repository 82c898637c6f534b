#pragma once

/// A function that is compiled for wider registers, too, and runs as the machine allows. Loops
/// whose every element is computed by itself, in files built with -ffp-contract=off, give the same
/// bits in every clone. (Clang 22 and the sanitizers, which cannot resolve clones that early, get
/// one.)
#if defined(__x86_64__) && !defined(__clang__) && !defined(__SANITIZE_THREAD__) && \
    !defined(__SANITIZE_ADDRESS__)
#define RAKS_SIMD_CLONES __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define RAKS_SIMD_CLONES
#endif
