#pragma once

/// Compiles a function twice, for any processor and for one with 256-bit vectors; the faster one that runs
/// here is chosen when the program starts. Used on loops that keep their partial sums in a fixed number of
/// lanes, so that both give the same bits. Sanitizers cannot run the selection, which happens before they are
/// set up.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define CARTWRIGHT_VECTOR_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define CARTWRIGHT_VECTOR_CLONES
#endif
