#include "solver/message_order.h"

#include <mpi.h>

#include <algorithm>
#include <cstring>
#include <list>
#include <vector>

namespace cleft {

namespace {

struct Message {
  MPI_Comm communicator;
  MPI_Status status;
  std::vector<char> bytes;
};

bool active = false;
std::list<Message> held;  // received, and not yet by MUMPS

/// Receives all that has arrived.
void take_what_is_there(MPI_Comm communicator) {
  for (;;) {
    Message message{communicator, {}, {}};
    int there = 0, count = 0;
    PMPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, communicator, &there, &message.status);
    if (!there) return;
    PMPI_Get_count(&message.status, MPI_BYTE, &count);
    message.bytes.resize(static_cast<std::size_t>(count));
    PMPI_Recv(message.bytes.data(), count, MPI_BYTE, message.status.MPI_SOURCE, message.status.MPI_TAG,
              communicator, &message.status);
    held.push_back(std::move(message));
  }
}

std::list<Message>::iterator first_held(int source, int tag, MPI_Comm communicator) {
  return std::find_if(held.begin(), held.end(), [&](const Message& m) {
    return m.communicator == communicator && (source == MPI_ANY_SOURCE || source == m.status.MPI_SOURCE) &&
           (tag == MPI_ANY_TAG || tag == m.status.MPI_TAG);
  });
}

void give(const MPI_Status& status, MPI_Fint* to) {
  if (to != MPI_F_STATUS_IGNORE) PMPI_Status_c2f(&status, to);
}

}  // namespace

MessageOrder::MessageOrder() { active = true; }
MessageOrder::~MessageOrder() { active = false; }

}  // namespace cleft

// MPI's receiving calls as Fortran makes them, in the place of the library's own.
extern "C" {

void mpi_iprobe_(MPI_Fint* source, MPI_Fint* tag, MPI_Fint* communicator, MPI_Fint* there, MPI_Fint* status,
                 MPI_Fint* error) {
  using namespace cleft;
  const MPI_Comm comm = PMPI_Comm_f2c(*communicator);
  *error = MPI_SUCCESS;
  *there = 0;
  if (active) return take_what_is_there(comm);
  if (const auto message = first_held(*source, *tag, comm); message != held.end()) {
    *there = 1;
    return give(message->status, status);
  }
  int flag = 0;
  MPI_Status found;
  *error = PMPI_Iprobe(*source, *tag, comm, &flag, &found);
  *there = flag;
  if (flag) give(found, status);
}

void mpi_probe_(MPI_Fint* source, MPI_Fint* tag, MPI_Fint* communicator, MPI_Fint* status, MPI_Fint* error) {
  using namespace cleft;
  const MPI_Comm comm = PMPI_Comm_f2c(*communicator);
  *error = MPI_SUCCESS;
  if (const auto message = first_held(*source, *tag, comm); message != held.end())
    return give(message->status, status);
  MPI_Status found;
  *error = PMPI_Probe(*source, *tag, comm, &found);
  give(found, status);
}

void mpi_recv_(void* data, MPI_Fint* count, MPI_Fint* type, MPI_Fint* source, MPI_Fint* tag,
               MPI_Fint* communicator, MPI_Fint* status, MPI_Fint* error) {
  using namespace cleft;
  const MPI_Comm comm = PMPI_Comm_f2c(*communicator);
  *error = MPI_SUCCESS;
  if (const auto message = first_held(*source, *tag, comm); message != held.end()) {
    if (!message->bytes.empty()) std::memcpy(data, message->bytes.data(), message->bytes.size());
    give(message->status, status);
    held.erase(message);
    return;
  }
  MPI_Status found;
  *error = PMPI_Recv(data, *count, PMPI_Type_f2c(*type), *source, *tag, comm, &found);
  give(found, status);
}
}
