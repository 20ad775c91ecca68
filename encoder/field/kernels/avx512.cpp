// AVX-512.
#include "encoder/field/kernels/tables.h"

#define CLEFT_TARGET __attribute__((target("avx2,fma,avx512f,avx512vl,avx512dq")))
#define CLEFT_WIDE true
#include "encoder/field/kernels/bodies.h"

namespace cleft {

#ifdef CLEFT_X86
const KernelTable avx512_kernels = KERNELS;
#endif

}  // namespace cleft
