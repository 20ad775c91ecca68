// The kernels of each width, one translation unit each.
#pragma once

#include "encoder/field/kernels.h"

#if defined(__x86_64__)
#define CLEFT_X86
#endif

namespace cleft {

extern const KernelTable plain_kernels;
#ifdef CLEFT_X86
extern const KernelTable avx2_kernels, avx512_kernels;
#endif

}  // namespace cleft
