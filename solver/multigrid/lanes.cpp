#include "solver/multigrid/lanes.h"

namespace cleft {

namespace {

namespace plain {
#define CLEFT_TARGET
#include "solver/multigrid/lane_bodies.h"
#undef CLEFT_TARGET
}  // namespace plain

#if defined(__x86_64__)
namespace avx2 {
#define CLEFT_TARGET __attribute__((target("avx2,fma")))
#include "solver/multigrid/lane_bodies.h"
#undef CLEFT_TARGET
}  // namespace avx2

namespace avx512 {
#define CLEFT_TARGET __attribute__((target("avx2,fma,avx512f,avx512vl,avx512dq")))
#include "solver/multigrid/lane_bodies.h"
#undef CLEFT_TARGET
}  // namespace avx512
#endif

}  // namespace

const LaneTable& lane_table(int lanes) {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) {
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
        __builtin_cpu_supports("avx512dq"))
      return avx512::of(lanes);
    return avx2::of(lanes);
  }
#endif
  return plain::of(lanes);
}

}  // namespace cleft
