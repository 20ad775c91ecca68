// MPI from the beginning of main to its end.
#pragma once

#include <deal.II/base/mpi.h>
#include <stdlib.h>

namespace cleft {

class MpiSession {
 public:
  MpiSession(int& argc, char**& argv) : session_(prepared(argc), argv, 1) {}

  int rank() const { return static_cast<int>(dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD)); }
  int ranks() const { return static_cast<int>(dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD)); }

 private:
  /// A process of its own, started by neither mpirun nor srun, talks to nobody: without these Open MPI would
  /// start a daemon for it and share a folder with all others of its kind, which now and then fails when many
  /// start together.
  static int& prepared(int& argc) {
    for (const char* by_launcher : {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK"})
      if (getenv(by_launcher)) return argc;
    setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
    setenv("OMPI_MCA_orte_create_session_dirs", "0", 0);
    setenv("OMPI_MCA_btl", "self", 0);
    return argc;
  }

  dealii::Utilities::MPI::MPI_InitFinalize session_;
};

}  // namespace cleft
