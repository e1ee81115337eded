// SPDX-License-Identifier: BSD-3-Clause
#include "Pipeline/MeshOutput.h"

#include "vtkCellArray.h"
#include "vtkDataArray.h"

#include <gtest/gtest.h>

#include <numeric>

namespace
{

template <typename Id>
tipp::Buffer<Id> ascending(std::size_t size)
{
  tipp::Buffer<Id> ids(size);
  std::iota(ids.begin(), ids.end(), Id(0));
  return ids;
}

void expectAscendingCells(vtkCellArray* cells, vtkIdType count, vtkIdType size)
{
  ASSERT_EQ(count, cells->GetNumberOfCells());
  EXPECT_TRUE(cells->IsValid());
  for (vtkIdType cell = 0; cell < count; ++cell)
  {
    vtkIdType found;
    const vtkIdType* ids;
    cells->GetCellAtId(cell, found, ids);
    ASSERT_EQ(size, found);
    EXPECT_EQ(cell * size, ids[0]);
    EXPECT_EQ(cell * size + size - 1, ids[size - 1]);
  }
}

} // namespace

TEST(CellBuffers, IdsOf32BitsAreNotCopied)
{
  auto ids = ascending<std::int32_t>(12);
  const void* memory = ids.data();
  const auto cells = tipp::takeCells(std::move(ids), 3);
  EXPECT_FALSE(cells->IsStorage64Bit());
  EXPECT_EQ(memory, cells->GetConnectivityArray()->GetVoidPointer(0));
  expectAscendingCells(cells, 4, 3);
}

TEST(CellBuffers, IdsOf64BitsAreNotCopied)
{
  auto ids = ascending<std::int64_t>(12);
  const void* memory = ids.data();
  const auto cells = tipp::takeCells(std::move(ids), 2);
  EXPECT_TRUE(cells->IsStorage64Bit());
  EXPECT_EQ(memory, cells->GetConnectivityArray()->GetVoidPointer(0));
  expectAscendingCells(cells, 6, 2);
}

TEST(CellBuffers, OffsetsBeyond32BitsWidenTheCells)
{
  const auto atTheLimit = tipp::takeCells(ascending<std::int32_t>(12), 3, 12);
  EXPECT_FALSE(atTheLimit->IsStorage64Bit());
  const auto cells = tipp::takeCells(ascending<std::int32_t>(12), 3, 11);
  EXPECT_TRUE(cells->IsStorage64Bit());
  expectAscendingCells(cells, 4, 3);
}

TEST(CellBuffers, NoIdsMakeNoCells)
{
  const auto cells = tipp::takeCells(tipp::Buffer<std::int32_t>(), 3);
  EXPECT_EQ(0, cells->GetNumberOfCells());
  EXPECT_TRUE(cells->IsValid());
}

TEST(CellBuffers, LargeBuffersAreNotCopiedEither)
{
  const auto cells = tipp::takeCells(ascending<std::int32_t>(6000000), 3);
  EXPECT_EQ(2000000, cells->GetNumberOfCells());
  EXPECT_EQ(3, cells->GetCellSize(1999999));
}
