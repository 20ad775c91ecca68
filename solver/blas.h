// BLAS as MUMPS calls it: one thread where several would wait for each other, and products with one column as
// products of a matrix and a vector.
#pragma once

namespace cleft {

/// While one lives, and unless `wanted` is false, OpenBLAS computes with one thread; afterwards with as many
/// as before. Any other BLAS is left as it is. (The threads of OpenBLAS spin while they wait.)
class OneBlasThread {
 public:
  explicit OneBlasThread(bool wanted = true);
  ~OneBlasThread();
  OneBlasThread(const OneBlasThread&) = delete;
  OneBlasThread& operator=(const OneBlasThread&) = delete;

 private:
  int before_ = 0;  // threads; 0: nothing was changed
};

}  // namespace cleft
