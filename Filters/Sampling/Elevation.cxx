// SPDX-License-Identifier: BSD-3-Clause
#include "Sampling/Elevation.h"

#include "Messages/Communicator.h"
#include "Sampling/SamplingRange.h"
#include "Vtk/ReadDataSet.h"

#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"

namespace tipp
{

void HeightRange::add(vtkPointSet* mesh)
{
  const vtkIdType points = mesh->GetNumberOfPoints();
  if (points > 0 && allPointsFinite(mesh))
  {
    const double* const bounds = mesh->GetBounds(); // cached by VTK
    this->add(bounds[4]);
    this->add(bounds[5]);
    return;
  }
  for (vtkIdType i = 0; i < points; ++i)
  {
    double p[3];
    mesh->GetPoint(i, p);
    this->add(p[2]);
  }
}

void HeightRange::gather(Communicator& ranks)
{
  ByteWriter writer;
  writer.value(*this);
  for (const Bytes& bytes : ranks.gather(writer.take()))
  {
    const auto other = ByteReader(bytes).value<HeightRange>();
    this->add(other.Low);
    this->add(other.High);
  }
  writer.value(*this);
  *this = ByteReader(ranks.broadcast(writer.take())).value<HeightRange>();
}

bool haveElevation(const std::vector<vtkPointSet*>& meshes, Communicator& ranks)
{
  const bool surfaces = areSurfaces(meshes, ranks);
  HeightRange heights;
  for (vtkPointSet* mesh : meshes)
  {
    heights.add(mesh);
  }
  heights.gather(ranks);
  return surfaces && !heights.isFlat();
}

vtkSmartPointer<vtkPointSet> withElevation(vtkPointSet* mesh)
{
  if (!mesh->GetPoints() || mesh->GetPointData()->HasArray(elevationName))
  {
    return mesh;
  }
  auto copy = vtkSmartPointer<vtkPointSet>::Take(mesh->NewInstance());
  copy->ShallowCopy(mesh);
  vtkDataArray* const points = mesh->GetPoints()->GetData();
  const auto heights =
    vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(points->GetDataType()));
  heights->SetName(elevationName);
  heights->SetNumberOfTuples(points->GetNumberOfTuples());
  heights->CopyComponent(0, points, 2);
  copy->GetPointData()->AddArray(heights);
  return copy;
}

} // namespace tipp
