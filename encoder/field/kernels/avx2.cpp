// AVX2 with FMA.
#include "encoder/field/kernels/tables.h"

#define CLEFT_TARGET __attribute__((target("avx2,fma")))
#define CLEFT_WIDE true
#include "encoder/field/kernels/bodies.h"

namespace cleft {

#ifdef CLEFT_X86
const KernelTable avx2_kernels = KERNELS;
#endif

}  // namespace cleft
