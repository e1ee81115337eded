// SPDX-License-Identifier: BSD-3-Clause
#include "Console/MpiSession.h"

#include "vtkMultiProcessController.h"

#ifdef TIPP_USE_MPI
#include "vtkMPIController.h"

#include <mpi.h>
#endif

#include <cstdlib>
#include <stdexcept>

namespace tipp
{

int startedRank()
{
  for (const char* const name : { "OMPI_COMM_WORLD_RANK", "PMI_RANK", "PMIX_RANK" })
  {
    if (const char* const rank = std::getenv(name))
    {
      return std::atoi(rank);
    }
  }
  return -1;
}

MpiSession::MpiSession()
{
  // MPI_Init() in a process that was not started as a rank takes time, and may fail without a
  // network.
  if (startedRank() < 0)
  {
    return;
  }
#ifdef TIPP_USE_MPI
  // FUNNELED: only the main thread calls MPI.
  int provided = MPI_THREAD_SINGLE;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
  this->Controller = vtkMPIController::New();
  this->Controller->Initialize(nullptr, nullptr, 1);
  vtkMultiProcessController::SetGlobalController(this->Controller);
#else
  throw std::runtime_error("this tipp was built without MPI and cannot run on several ranks; start "
                           "it without mpirun, or build it with -DTIPP_USE_MPI=ON.");
#endif
}

MpiSession::~MpiSession()
{
#ifdef TIPP_USE_MPI
  if (this->Controller)
  {
    vtkMultiProcessController::SetGlobalController(nullptr);
    this->Controller->Finalize(1);
    this->Controller->Delete();
    MPI_Finalize();
  }
#endif
}

vtkMultiProcessController* MpiSession::controller() const
{
  return this->Controller;
}

bool MpiSession::isFirst() const
{
  return !this->Controller || this->Controller->GetLocalProcessId() == 0;
}

} // namespace tipp
