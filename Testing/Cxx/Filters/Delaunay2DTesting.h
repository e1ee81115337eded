// SPDX-License-Identifier: BSD-3-Clause
#ifndef Delaunay2DTesting_h
#define Delaunay2DTesting_h

// Shared by the tests of vtkTIPPDelaunay2D.

#include "Predicates/Geometry.h"
#include "vtkTIPPDelaunay2D.h"

#include "vtkAlgorithm.h"
#include "vtkCellArray.h"
#include "vtkCommand.h"
#include "vtkExecutive.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <initializer_list>
#include <random>
#include <set>
#include <string>
#include <vector>

namespace testing_delaunay
{

using tipp::Point3;

inline vtkSmartPointer<vtkPolyData> dataset(
  const std::vector<Point3>& points, int dataType = VTK_DOUBLE)
{
  vtkNew<vtkPoints> vtk;
  vtk->SetDataType(dataType);
  for (const Point3& p : points)
  {
    vtk->InsertNextPoint(p.x, p.y, p.z);
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(vtk);
  return data;
}

/// Random points in the unit cube. No three are collinear in any coordinate plane.
inline std::vector<Point3> randomPoints(int count, unsigned seed = 1)
{
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<Point3> points(static_cast<std::size_t>(count));
  for (Point3& p : points)
  {
    p = { uniform(generator), uniform(generator), uniform(generator) };
  }
  return points;
}

using Cells = std::multiset<std::vector<vtkIdType>>;

/// The cells, each as its sorted point ids, so that they compare equal in any order.
inline Cells cellsOf(vtkCellArray* cells)
{
  Cells result;
  vtkIdType size;
  const vtkIdType* ids;
  for (cells->InitTraversal(); cells->GetNextCell(size, ids);)
  {
    std::vector<vtkIdType> cell(ids, ids + size);
    std::sort(cell.begin(), cell.end());
    result.insert(cell);
  }
  return result;
}

/// Counts the warnings and errors of an algorithm instead of printing them.
class Messages
{
public:
  explicit Messages(vtkObject* subject)
  {
    subject->AddObserver(vtkCommand::WarningEvent, this, &Messages::hearWarning);
    subject->AddObserver(vtkCommand::ErrorEvent, this, &Messages::hearError);
  }

  std::vector<std::string> Warnings;
  std::vector<std::string> Errors;

private:
  void hearWarning(vtkObject*, unsigned long, void* text)
  {
    this->Warnings.emplace_back(static_cast<const char*>(text));
  }
  void hearError(vtkObject*, unsigned long, void* text)
  {
    this->Errors.emplace_back(static_cast<const char*>(text));
  }
};

/// Updates an algorithm and returns its triangles.
inline Cells trianglesOf(vtkPolyDataAlgorithm* algorithm)
{
  algorithm->Update();
  return cellsOf(algorithm->GetOutput()->GetPolys());
}

} // namespace testing_delaunay

#endif
