// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCommunicator.h"
#include "vtkMultiProcessController.h"

#include <gtest/gtest.h>

#include <cstdlib>

TEST(MpiMain, TheGlobalControllerHasAllRanks)
{
  vtkMultiProcessController* controller = vtkMultiProcessController::GetGlobalController();
  ASSERT_NE(controller, nullptr);
  const char* started = std::getenv("TIPP_TEST_RANKS");
  ASSERT_NE(started, nullptr);
  EXPECT_EQ(controller->GetNumberOfProcesses(), std::atoi(started));
}

TEST(MpiMain, RanksCanCommunicate)
{
  vtkMultiProcessController* controller = vtkMultiProcessController::GetGlobalController();
  const int one = 1;
  int sum = 0;
  controller->AllReduce(&one, &sum, 1, vtkCommunicator::SUM_OP);
  EXPECT_EQ(sum, controller->GetNumberOfProcesses());
}
