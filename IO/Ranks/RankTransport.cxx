// SPDX-License-Identifier: BSD-3-Clause
#include "Ranks/Communicator.h"

#ifdef TIPP_HAVE_MPI
#include "vtkMPIController.h"
#include "vtkSmartPointer.h"
#elif !defined(TIPP_WITHOUT_VTK)
#include "vtkMultiProcessController.h"
#endif

#include <stdexcept>
#include <string>

namespace tipp
{
#ifdef TIPP_HAVE_MPI
namespace
{

class MpiSending : public RankTransport::Sending
{
public:
  bool hasLeft() override { return this->Request.Test() != 0; }
  vtkMPICommunicator::Request Request;
};

class MpiTransport : public RankTransport
{
public:
  /// Uses its own communicator, so that its messages are not mixed with the program's other
  /// messages.
  explicit MpiTransport(vtkMPIController* all)
    : Rank(all->GetLocalProcessId())
    , Size(all->GetNumberOfProcesses())
  {
    this->Controller.TakeReference(
      vtkMPIController::SafeDownCast(all->PartitionController(0, this->Rank)));
  }

  int rank() const override { return this->Rank; }
  int size() const override { return this->Size; }

  std::unique_ptr<Sending> send(const char* data, std::size_t size, int to, int tag) override
  {
    auto sending = std::make_unique<MpiSending>();
    this->Controller->NoBlockSend(data, static_cast<int>(size), to, tag, sending->Request);
    return sending;
  }

  bool probe(int tag, int& source, int& size) override
  {
    int found = 0;
    const char* const type = nullptr;
    this->Controller->Iprobe(
      vtkMultiProcessController::ANY_SOURCE, tag, &found, &source, type, &size);
    return found != 0;
  }

  void receive(char* data, std::size_t size, int source, int tag) override
  {
    this->Controller->Receive(data, static_cast<vtkIdType>(size), source, tag);
  }

private:
  int Rank;
  int Size;
  vtkSmartPointer<vtkMPIController> Controller;
};

} // namespace

std::unique_ptr<RankTransport> RankTransport::open(vtkMultiProcessController* controller)
{
  if (!controller || controller->GetNumberOfProcesses() < 2)
  {
    return nullptr;
  }
  auto* const mpi = vtkMPIController::SafeDownCast(controller);
  if (!mpi)
  {
    throw std::invalid_argument(std::string("The controller is a ") + controller->GetClassName() +
      "; several ranks need a vtkMPIController.");
  }
  return std::make_unique<MpiTransport>(mpi);
}

#else

std::unique_ptr<RankTransport> RankTransport::open(
  [[maybe_unused]] vtkMultiProcessController* controller)
{
#ifndef TIPP_WITHOUT_VTK
  if (controller && controller->GetNumberOfProcesses() > 1)
  {
    throw std::invalid_argument("TIPP was built without MPI, so that it works on one rank alone; "
                                "build it with -DTIPP_USE_MPI=ON against a VTK that has MPI.");
  }
#endif
  return nullptr;
}

#endif

} // namespace tipp
