// SPDX-License-Identifier: BSD-3-Clause
#include "CellStorages.h"
#include "Vtk/CellArrays.h"

#include "vtkIntArray.h"
#include "vtkSOADataArrayTemplate.h"

#include <gtest/gtest.h>

namespace
{

std::vector<std::int64_t> valuesOf(const tipp::PlainIds& ids)
{
  std::vector<std::int64_t> values;
  for (std::int64_t i = 0; i < ids.count(); ++i)
  {
    values.push_back(ids.isWide() ? static_cast<const std::int64_t*>(ids.data())[i]
                                  : static_cast<const std::int32_t*>(ids.data())[i]);
  }
  return values;
}

} // namespace

TEST(PlainIds, SharesMemoryOfPlainIntegers)
{
  const auto narrow = arrayOf<vtkIntArray>({ 3, -1 });
  const auto wide = arrayOf<vtkTypeInt64Array>({ 4, std::int64_t(1) << 40 });
  EXPECT_EQ(narrow->GetPointer(0), tipp::PlainIds(narrow).data());
  EXPECT_FALSE(tipp::PlainIds(narrow).isWide());
  EXPECT_EQ(wide->GetPointer(0), tipp::PlainIds(wide).data());
  EXPECT_TRUE(tipp::PlainIds(wide).isWide());
}

TEST(PlainIds, CopiesOtherLayoutsAndTypes)
{
  const auto separate = vtkSmartPointer<vtkSOADataArrayTemplate<int>>::New();
  separate->SetNumberOfComponents(2);
  separate->InsertNextTuple2(1, 2);
  separate->InsertNextTuple2(3, 4);
  EXPECT_EQ((std::vector<std::int64_t>{ 1, 2, 3, 4 }), valuesOf(tipp::PlainIds(separate)));
  const auto shorts = arrayOf<vtkShortArray>({ 7, -8 });
  EXPECT_EQ((std::vector<std::int64_t>{ 7, -8 }), valuesOf(tipp::PlainIds(shorts)));
}

TEST(PlainIds, ANullArrayHasNoIds)
{
  EXPECT_EQ(0, tipp::PlainIds().count());
  EXPECT_EQ(nullptr, tipp::PlainIds(nullptr).data());
}

TEST(PlainIds, EveryStorageOfCellsHasTheSameIdsAndOffsets)
{
  const std::vector<std::int64_t> ids = { 0, 1, 2, 2, 1, 3, 3, 1, 4 };
  for (const auto& [name, storage] : cellStorages())
  {
    const tipp::PlainCells cells(storedCells(storage, ids, 3));
    EXPECT_EQ(cells.Ids.isWide(), cells.Offsets.isWide()) << name;
    EXPECT_EQ(ids, valuesOf(cells.Ids)) << name;
    EXPECT_EQ((std::vector<std::int64_t>{ 0, 3, 6, 9 }), valuesOf(cells.Offsets)) << name;
  }
}
