// SPDX-License-Identifier: BSD-3-Clause
// The tool in a build without MPI.
#include "RunTipp.h"

#include <gtest/gtest.h>

#include <cstdlib>

TEST(TippWithoutMpi, RefusesToRunAsOneOfSeveralRanks)
{
  const tipp::test::TemporaryFolder folder;
  setenv("OMPI_COMM_WORLD_RANK", "0", 1);
  const tipp::test::Outcome outcome =
    tipp::test::runTipp(folder, { "delaunay", "uniform:100", "-o", "mesh.vtp" });
  unsetenv("OMPI_COMM_WORLD_RANK");
  EXPECT_EQ(1, outcome.ExitCode);
  EXPECT_NE(std::string::npos, outcome.Err.find("built without MPI")) << outcome.Err;
}
