// SPDX-License-Identifier: BSD-3-Clause
#include "Arrays/Scalar.h"

#include "vtkType.h"

#include <gtest/gtest.h>

using tipp::Scalar;

TEST(ScalarTypes, OfVtkAreMappedBySizeAndSign)
{
  EXPECT_EQ(tipp::scalarOf(VTK_FLOAT), Scalar::Float32);
  EXPECT_EQ(tipp::scalarOf(VTK_DOUBLE), Scalar::Float64);
  EXPECT_EQ(tipp::scalarOf(VTK_UNSIGNED_CHAR), Scalar::UInt8);
  EXPECT_EQ(tipp::scalarOf(VTK_SHORT), Scalar::Int16);
  EXPECT_EQ(tipp::scalarOf(VTK_UNSIGNED_INT), Scalar::UInt32);
  EXPECT_EQ(tipp::scalarOf(VTK_LONG_LONG), Scalar::Int64);
  EXPECT_EQ(tipp::scalarOf(VTK_ID_TYPE), sizeof(vtkIdType) == 8 ? Scalar::Int64 : Scalar::Int32);
}

TEST(ScalarTypes, DoNotExistForBitsAndStrings)
{
  EXPECT_FALSE(tipp::scalarOf(VTK_BIT));
  EXPECT_FALSE(tipp::scalarOf(VTK_STRING));
}

TEST(ScalarTypes, AreMappedToVtkAndBack)
{
  for (int i = int(Scalar::Int8); i <= int(Scalar::Float64); ++i)
  {
    EXPECT_EQ(tipp::scalarOf(tipp::vtkTypeOf(Scalar(i))), Scalar(i));
  }
}
