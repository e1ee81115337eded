// SPDX-License-Identifier: BSD-3-Clause
// A VTK filter over the core: the edges of a Delaunay triangulation.
#include "Triangulation/Triangulate.h"

#include "vtkCellArray.h"
#include "vtkFloatArray.h"
#include "vtkInformation.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolyDataAlgorithm.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace
{

class DelaunayEdges : public vtkPolyDataAlgorithm
{
public:
  static DelaunayEdges* New();
  vtkTypeMacro(DelaunayEdges, vtkPolyDataAlgorithm)

protected:
  int RequestData(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override
  {
    vtkPolyData* const input = vtkPolyData::GetData(inputs[0]);
    vtkPolyData* const output = vtkPolyData::GetData(outputs);
    try
    {
      output->SetPoints(input->GetPoints());
      output->SetLines(this->edgesOf(input->GetPoints()));
      return 1;
    }
    catch (const std::exception& error) // no exception may leave a VTK class
    {
      vtkErrorMacro("Triangulating " << input->GetNumberOfPoints() << " points: " << error.what());
      output->Initialize();
      return 0;
    }
  }

private:
  vtkSmartPointer<vtkCellArray> edgesOf(vtkPoints* points)
  {
    std::vector<double> xy;
    for (vtkIdType i = 0; points && i < points->GetNumberOfPoints(); ++i)
    {
      const double* const p = points->GetPoint(i);
      xy.insert(xy.end(), { p[0], p[1] });
    }
    tipp::TriangulationOptions options;
    options.Progress = [this](double done)
    {
      this->UpdateProgress(done);
      return !this->GetAbortExecute();
    };
    const tipp::Triangulation mesh =
      tipp::triangulate(tipp::PointsView(xy.data(), xy.size() / 2, 2), options);
    auto edges = vtkSmartPointer<vtkCellArray>::New();
    for (std::size_t i = 0; i < mesh.Ids32.size(); ++i)
    {
      const vtkIdType a = mesh.Ids32[i];
      const vtkIdType b = mesh.Ids32[i / 3 * 3 + (i + 1) % 3];
      if (a < b || isHullEdge(mesh, a, b))
      {
        const vtkIdType ids[] = { a, b };
        edges->InsertNextCell(2, ids);
      }
    }
    return edges;
  }

  /// Whether no triangle has the edge from b to a.
  static bool isHullEdge(const tipp::Triangulation& mesh, vtkIdType a, vtkIdType b)
  {
    for (std::size_t i = 0; i < mesh.Ids32.size(); ++i)
    {
      if (mesh.Ids32[i] == b && mesh.Ids32[i / 3 * 3 + (i + 1) % 3] == a)
      {
        return false;
      }
    }
    return true;
  }
};

vtkStandardNewMacro(DelaunayEdges);

TEST(ExtendingFilter, HasEveryEdgeOnce)
{
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(0, 0, 0);
  points->InsertNextPoint(2, 0, 0);
  points->InsertNextPoint(2, 2, 0);
  points->InsertNextPoint(0, 2, 0);
  points->InsertNextPoint(1, 0.5, 0);
  vtkNew<vtkPolyData> input;
  input->SetPoints(points);
  vtkNew<DelaunayEdges> filter;
  filter->SetInputData(input);
  filter->Update();
  EXPECT_EQ(8, filter->GetOutput()->GetNumberOfLines());
}

TEST(ExtendingFilter, WithoutPointsHasNoEdges)
{
  vtkNew<vtkPolyData> input;
  vtkNew<DelaunayEdges> filter;
  filter->SetInputData(input);
  filter->Update();
  EXPECT_EQ(0, filter->GetOutput()->GetNumberOfLines());
}

} // namespace
