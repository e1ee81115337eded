// SPDX-License-Identifier: BSD-3-Clause
// main() of a test program for several ranks. Every rank runs every test, and the program fails if
// a test fails on any rank. The global controller is VTK's MPI controller, or in a build without
// MPI a controller of one rank.
#include "vtkNew.h"

#include <gtest/gtest.h>

#ifndef TIPP_USE_MPI

#include "vtkDummyController.h"

int main(int argc, char* argv[])
{
  testing::InitGoogleTest(&argc, argv);
  vtkNew<vtkDummyController> controller;
  vtkMultiProcessController::SetGlobalController(controller);
  const int failed = RUN_ALL_TESTS();
  vtkMultiProcessController::SetGlobalController(nullptr);
  return failed;
}

#else

#include "vtkMPIController.h"

#include <mpi.h>

namespace
{

/// Only the first rank prints successes; the others print failures.
void silenceSuccesses()
{
  testing::TestEventListeners& listeners = testing::UnitTest::GetInstance()->listeners();
  class FailuresOnly : public testing::EmptyTestEventListener
  {
    void OnTestPartResult(const testing::TestPartResult& result) override
    {
      if (result.failed())
      {
        std::fprintf(stderr, "%s:%d: %s\n", result.file_name() ? result.file_name() : "?",
          result.line_number(), result.message());
      }
    }
  };
  delete listeners.Release(listeners.default_result_printer());
  listeners.Append(new FailuresOnly);
}

} // namespace

int main(int argc, char* argv[])
{
  // FUNNELED: other threads run beside the main thread, but only the main thread calls MPI.
  int provided = MPI_THREAD_SINGLE;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided);
  testing::InitGoogleTest(&argc, argv);
  int failedAnywhere = 1;
  {
    vtkNew<vtkMPIController> controller;
    controller->Initialize(&argc, &argv, 1);
    vtkMultiProcessController::SetGlobalController(controller);
    if (controller->GetLocalProcessId() != 0)
    {
      silenceSuccesses();
    }
    const int failed = RUN_ALL_TESTS();
    controller->AllReduce(&failed, &failedAnywhere, 1, vtkCommunicator::MAX_OP);
    vtkMultiProcessController::SetGlobalController(nullptr);
    controller->Finalize(1);
  }
  MPI_Finalize();
  return failedAnywhere;
}

#endif
