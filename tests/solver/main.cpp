// GoogleTest under MPI.
#include <gtest/gtest.h>

#include "solver/mpi_session.h"

int main(int argc, char** argv) {
  const cleft::MpiSession mpi(argc, argv);
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
