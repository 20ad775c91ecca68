// What every machine has: the compiler divides the wide types.
#include "encoder/field/kernels/tables.h"

#define CLEFT_TARGET
#define CLEFT_WIDE false
#include "encoder/field/kernels/bodies.h"

namespace cleft {

const KernelTable plain_kernels = KERNELS;

}  // namespace cleft
