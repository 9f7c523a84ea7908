#pragma once

/// Marks a function of simple loops to be compiled, with all that it calls, for AVX-512, AVX2 and the baseline of its
/// processor family; the fitting one is chosen when the program starts. As products are never fused with sums
/// (-ffp-contract=off), all give the same bits.
#if defined(JOSTLE_ONLY_FOR)  // one family alone, which a test compares with the others
#define JOSTLE_VECTORISED __attribute__((flatten, target(JOSTLE_ONLY_FOR)))
#elif defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define JOSTLE_VECTORISED __attribute__((flatten, target_clones("default", "avx2", "arch=skylake-avx512")))
#else
#define JOSTLE_VECTORISED
#endif
