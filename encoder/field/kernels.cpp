#include "encoder/field/kernels.h"

#include "base/error.h"
#include "encoder/field/kernels/tables.h"

namespace cleft {

const std::vector<Kernel>& available_kernels() {
  static const std::vector<Kernel> kernels = [] {
    std::vector<Kernel> list{Kernel::plain};
#ifdef CLEFT_X86
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) {
      list.push_back(Kernel::avx2);
      if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
          __builtin_cpu_supports("avx512dq"))
        list.push_back(Kernel::avx512);
    }
#endif
    return list;
  }();
  return kernels;
}

const char* name_of(Kernel kernel) {
  return kernel == Kernel::plain ? "plain" : kernel == Kernel::avx2 ? "avx2" : "avx512";
}

const KernelTable& kernel_table(Kernel kernel) {
  CLEFT_CHECK(static_cast<int>(kernel), <=, static_cast<int>(available_kernels().back()));
#ifdef CLEFT_X86
  if (kernel == Kernel::avx512) return avx512_kernels;
  if (kernel == Kernel::avx2) return avx2_kernels;
#endif
  return plain_kernels;
}

}  // namespace cleft
