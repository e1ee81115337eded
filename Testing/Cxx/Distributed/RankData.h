// SPDX-License-Identifier: BSD-3-Clause
// Data sets of ranks for vtkTIPPDelaunay2D.
#ifndef tippRankData_h
#define tippRankData_h

#include "DistributedTesting.h"

#include "vtkTIPPDelaunay2D.h"

#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <cstddef>

namespace tipp
{
namespace test
{

/// This rank's share of the points, with z, a point array and, if `withIds`, global ids.
inline vtkSmartPointer<vtkPolyData> shareAsData(const Coordinates& xy, bool withIds)
{
  const RankShare mine = shareOf(xy, withIds ? Share::RoundRobin : Share::Blocks, rank(), ranks());
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> height;
  height->SetName("height");
  vtkNew<vtkIdTypeArray> ids;
  ids->SetName("ids");
  for (std::size_t i = 0; i < mine.GlobalIds.size(); ++i)
  {
    const double id = double(mine.GlobalIds[i]);
    points->InsertNextPoint(mine.XY[2 * i], mine.XY[2 * i + 1], id);
    height->InsertNextValue(3 * id);
    ids->InsertNextValue(mine.GlobalIds[i]);
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->GetPointData()->AddArray(height);
  if (withIds)
  {
    data->GetPointData()->SetGlobalIds(ids);
  }
  return data;
}

/// Updates a filter, and expects that it fails and outputs no cells.
inline void expectNoOutput(vtkTIPPDelaunay2D* filter)
{
  vtkObject::GlobalWarningDisplayOff();
  filter->Update();
  vtkObject::GlobalWarningDisplayOn();
  EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), 0);
}

/// The global id of point i, which a double may not represent exactly.
inline vtkIdType idAt(vtkDataArray* ids, vtkIdType i)
{
  return static_cast<vtkIdTypeArray*>(ids)->GetValue(i);
}

} // namespace test
} // namespace tipp

#endif
