#pragma once

/// Marks what libazulejo shows to the outside; everything else is hidden.
#if defined(_WIN32)
#define AZULEJO_EXPORT __declspec(dllexport)
#else
#define AZULEJO_EXPORT __attribute__((visibility("default")))
#endif
