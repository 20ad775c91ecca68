// MPI from the beginning of main to its end.
#pragma once

#include <memory>

namespace dealii::Utilities::MPI {
class MPI_InitFinalize;
}

namespace cleft {

class MpiSession {
 public:
  MpiSession(int& argc, char**& argv);
  ~MpiSession();
  MpiSession(const MpiSession&) = delete;
  MpiSession& operator=(const MpiSession&) = delete;

  int rank() const;
  int ranks() const;

  /// Discards standard output and error of this rank from now on, except for the message of abort().
  void silence();

  /// Ends all ranks at once after a failure on this one: the others may wait for it, and libraries that
  /// failed half-way (HDF5 on a full disk) do not survive their own end. Rank 0 has printed the reason;
  /// another rank waits until it can have done so.
  [[noreturn]] void abort(int code) const;

 private:
  std::unique_ptr<dealii::Utilities::MPI::MPI_InitFinalize> session_;
  int error_;
};

}  // namespace cleft
