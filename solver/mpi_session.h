// MPI from the beginning of main to its end.
#pragma once

#include <deal.II/base/mpi.h>
#include <fcntl.h>
#include <stdlib.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <iostream>

#include "base/memory.h"

namespace cleft {

class MpiSession {
 public:
  MpiSession(int& argc, char**& argv) : session_(prepared(argc), argv, 1) { return_large_blocks(); }

  int rank() const { return static_cast<int>(dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD)); }
  int ranks() const { return static_cast<int>(dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD)); }

  /// Discards standard output and error of this rank from now on, except for the message of abort().
  void silence() {
    error_ = dup(STDERR_FILENO);
    const int nowhere = open("/dev/null", O_WRONLY);
    dup2(nowhere, STDOUT_FILENO), dup2(nowhere, STDERR_FILENO);
    close(nowhere);
  }

  /// Ends all ranks at once after a failure on this one: the others may wait for it, and libraries that
  /// failed half-way (HDF5 on a full disk) do not survive their own end. Rank 0 has printed the reason;
  /// another rank waits until it can have done so.
  [[noreturn]] void abort(int code) const {
    if (rank() > 0) {
      sleep(2);
      dprintf(error_, "cleft: failed on rank %d of %d\n", rank(), ranks());
    }
    std::cout.flush(), std::cerr.flush();
    if (ranks() > 1) MPI_Abort(MPI_COMM_WORLD, code);
    std::_Exit(code);
  }

 private:
  /// A process that neither mpirun nor srun started has no peers. Without these settings Open MPI would start
  /// a daemon for it and share a folder with other such processes, which sometimes fails when many start
  /// together.
  static int& prepared(int& argc) {
    for (const char* by_launcher : {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK"})
      if (getenv(by_launcher)) {
        prctl(PR_SET_PDEATHSIG, SIGKILL);  // a launcher that is killed leaves no rank behind
        return argc;
      }
    setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
    setenv("OMPI_MCA_orte_create_session_dirs", "0", 0);
    setenv("OMPI_MCA_btl", "self", 0);
    return argc;
  }

  dealii::Utilities::MPI::MPI_InitFinalize session_;
  int error_ = STDERR_FILENO;
};

}  // namespace cleft
