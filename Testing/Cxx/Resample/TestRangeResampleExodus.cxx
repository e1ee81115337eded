// SPDX-License-Identifier: BSD-3-Clause
#include "BesideProbeFilter.h"
#include "RealData.h"

#include "vtkCompositeDataIterator.h"
#include "vtkExodusIIReader.h"
#include "vtkMultiBlockDataSet.h"

#include <gtest/gtest.h>

TEST(RangeResampleRealMeshes, TheDisksHexahedraAreSampledLinearlyWhereVtkFindsThem)
{
  TIPP_REQUIRE_REAL_DATA(path, "tets/disk_out_ref.ex2");
  vtkNew<vtkExodusIIReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  const auto blocks =
    vtkSmartPointer<vtkCompositeDataIterator>::Take(reader->GetOutput()->NewIterator());
  blocks->InitTraversal();
  auto* const mesh = vtkDataSet::SafeDownCast(blocks->GetCurrentDataObject());
  ASSERT_NE(mesh, nullptr);
  ASSERT_GT(mesh->GetNumberOfCells(), 5000);
  ASSERT_EQ(mesh->GetCellType(0), VTK_HEXAHEDRON);
  expectLinearWhereVtkFindsIt(mesh);
}
