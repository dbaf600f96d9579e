#pragma once
// CLSURF_VECTORISED: a function compiled for AVX2 and for any machine; the loader chooses. Not under the thread
// sanitizer, whose runtime is not initialised yet when the loader asks.

#if defined(__x86_64__) && !defined(__SANITIZE_THREAD__)
#define CLSURF_VECTORISED [[gnu::target_clones("avx2", "default")]]
#else
#define CLSURF_VECTORISED
#endif
