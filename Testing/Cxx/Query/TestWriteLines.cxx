// SPDX-License-Identifier: BSD-3-Clause
// Lines in files are those of the data sets.
#include "Query/QueryData.h"
#include "Query/WriteLines.h"

#include "TemporaryFolder.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkXMLPolyDataReader.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace
{

using namespace tipp;
using namespace tipp::test;

void expectSameArrays(vtkDataSetAttributes* expected, vtkDataSetAttributes* found)
{
  ASSERT_EQ(expected->GetNumberOfArrays(), found->GetNumberOfArrays());
  for (int i = 0; i < expected->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* const array = expected->GetArray(i);
    vtkDataArray* const other = found->GetArray(array->GetName());
    ASSERT_TRUE(other) << array->GetName();
    ASSERT_EQ(array->GetNumberOfTuples(), other->GetNumberOfTuples());
    for (vtkIdType j = 0; j < array->GetNumberOfTuples(); ++j)
    {
      EXPECT_EQ(array->GetTuple1(j), other->GetTuple1(j)) << array->GetName() << ", " << j;
    }
  }
}

std::vector<vtkIdType> pointsOfLine(vtkPolyData* data, vtkIdType line)
{
  const vtkNew<vtkIdList> ids;
  data->GetCellPoints(line, ids);
  return { ids->begin(), ids->end() };
}

/// Compares the lines in a file with those of a data set.
void expectSameLines(vtkPolyData* expected, const std::string& path)
{
  const vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  vtkPolyData* const found = reader->GetOutput();
  ASSERT_EQ(expected->GetNumberOfPoints(), found->GetNumberOfPoints());
  for (vtkIdType i = 0; i < expected->GetNumberOfPoints(); ++i)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      EXPECT_EQ(expected->GetPoint(i)[axis], found->GetPoint(i)[axis]) << i;
    }
  }
  ASSERT_EQ(expected->GetNumberOfLines(), found->GetNumberOfLines());
  for (vtkIdType line = 0; line < expected->GetNumberOfLines(); ++line)
  {
    EXPECT_EQ(pointsOfLine(expected, line), pointsOfLine(found, line)) << line;
  }
  expectSameArrays(expected->GetPointData(), found->GetPointData());
  expectSameArrays(expected->GetCellData(), found->GetCellData());
}

} // namespace

TEST(WriteLines, ContoursAreThoseOfTheDataSet)
{
  const TemporaryFolder folder;
  Contours contours;
  contours.Points = { { 0, 0, 1 }, { 1, 0.1, 1 }, { 2, 0, 1 }, { 5, 5, 2.5 }, { 6, 5, 2.5 } };
  contours.Starts = { 0, 3, 5 };
  contours.Levels = { 1, 2.5 };
  writeContours(folder.path("a.vtp"), PathState(), contours, "level & more");
  expectSameLines(polyDataOf(contours, "level & more"), folder.path("a.vtp"));
}

TEST(WriteLines, DescentsAreThoseOfTheDataSet)
{
  const TemporaryFolder folder;
  Descents descents;
  descents.Points = { { 0, 0, 3 }, { 1, 0, 2 }, { 1, 1, 1 }, { 9, 9, 4 } };
  descents.Values = { 3, 2, 1, 4 };
  descents.Starts = { 0, 3, 3, 4 }; // three points, none, one
  descents.Pits = { 17, -1, 4 };
  writeDescents(folder.path("a.vtp"), PathState(), descents, "height");
  expectSameLines(polyDataOf(descents, "height"), folder.path("a.vtp"));
}

TEST(WriteLines, NoLinesAreAFileWithoutLines)
{
  const TemporaryFolder folder;
  writeContours(folder.path("a.vtp"), PathState(), Contours(), "level");
  expectSameLines(polyDataOf(Contours(), "level"), folder.path("a.vtp"));
}
