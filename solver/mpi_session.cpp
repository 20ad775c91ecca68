#include "solver/mpi_session.h"

#include <deal.II/base/mpi.h>
#include <fcntl.h>
#include <stdlib.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <iostream>

#include "base/memory.h"
#include "base/ranks/launcher.h"

namespace cleft {

namespace {

/// A process that neither mpirun nor srun started has no peers. Without these settings Open MPI would start
/// a daemon for it and share a folder with other such processes, which sometimes fails when many start
/// together.
int& prepared(int& argc) {
  if (has_launcher()) {
    end_with_launcher();
    return argc;
  }
  setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
  setenv("OMPI_MCA_orte_create_session_dirs", "0", 0);
  setenv("OMPI_MCA_btl", "self", 0);
  return argc;
}

}  // namespace

MpiSession::MpiSession(int& argc, char**& argv)
    : session_(std::make_unique<dealii::Utilities::MPI::MPI_InitFinalize>(prepared(argc), argv, 1)),
      error_(STDERR_FILENO) {
  return_large_blocks();
}

MpiSession::~MpiSession() = default;

int MpiSession::rank() const {
  return static_cast<int>(dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD));
}

int MpiSession::ranks() const {
  return static_cast<int>(dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD));
}

void MpiSession::silence() {
  error_ = dup(STDERR_FILENO);
  const int nowhere = open("/dev/null", O_WRONLY);
  dup2(nowhere, STDOUT_FILENO), dup2(nowhere, STDERR_FILENO);
  close(nowhere);
}

void MpiSession::abort(int code) const {
  if (rank() > 0) {
    sleep(2);
    dprintf(error_, "cleft: failed on rank %d of %d\n", rank(), ranks());
  }
  std::cout.flush(), std::cerr.flush();
  if (ranks() > 1) MPI_Abort(MPI_COMM_WORLD, code);
  std::_Exit(code);
}

}  // namespace cleft
