// SPDX-License-Identifier: BSD-3-Clause
// A pipeline from a stored mesh to an image, with every filter on all ranks.
#include "DistributedTesting.h"
#include "RangeResampleTesting.h"
#include "TemporaryFolder.h"

#include "vtkPartitionedUnstructuredReader.h"
#include "vtkPartitionedUnstructuredWriter.h"
#include "vtkRangeResampleFilter.h"
#include "vtkTIPPDelaunay2D.h"

#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

namespace
{

using namespace tipp;
using namespace tipp::test;

vtkSmartPointer<vtkPolyData> dataOf(const Coordinates& xy)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> height;
  height->SetName("height");
  for (std::size_t i = 0; i < xy.size() / 2; ++i)
  {
    points->InsertNextPoint(xy[2 * i], xy[2 * i + 1], 0);
    height->InsertNextValue(std::sin(7 * xy[2 * i]) * std::cos(5 * xy[2 * i + 1]));
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->GetPointData()->AddArray(height);
  return data;
}

void writeMesh(const Coordinates& xy, const std::string& path)
{
  vtkNew<vtkTIPPDelaunay2D> delaunay;
  delaunay->SetController(nullptr);
  delaunay->SetInputData(dataOf(xy));
  vtkNew<vtkPartitionedUnstructuredWriter> writer;
  writer->SetController(nullptr);
  writer->SetInputConnection(delaunay->GetOutputPort());
  writer->SetTiling("quadtree:400");
  writer->SetFileName(path.c_str());
  writer->Write();
}

/// Reads the mesh, triangulates its points again and samples the result, all with the same
/// controller.
struct Pipeline
{
  Pipeline(const std::string& path, vtkMultiProcessController* controller)
  {
    this->Reader->SetController(controller);
    this->Reader->SetFileName(path.c_str());
    this->Delaunay->SetController(controller);
    this->Delaunay->SetPointsPerPartition(100); // otherwise one rank would triangulate all points
    this->Delaunay->SetInputConnection(this->Reader->GetOutputPort());
    this->Resample->SetController(controller);
    this->Resample->SetInputConnection(this->Delaunay->GetOutputPort());
    this->Resample->SetSamplingDimensions(61, 47, 1);
  }

  vtkImageData* image()
  {
    this->Resample->Update();
    return this->Resample->GetOutput();
  }

  vtkNew<vtkPartitionedUnstructuredReader> Reader;
  vtkNew<vtkTIPPDelaunay2D> Delaunay;
  vtkNew<vtkRangeResampleFilter> Resample;
};

class PipelineOnRanks : public testing::TestWithParam<const char*>
{
protected:
  void SetUp() override
  {
    std::vector<char> name(4096, 0);
    if (rank() == 0)
    {
      this->Folder = std::make_unique<TemporaryFolder>();
      const std::string path = this->Folder->path("mesh.tipp");
      std::copy(path.begin(), path.end(), name.begin());
      writeMesh(makePointSet(GetParam(), 4000, 5), path);
    }
    this->Controller->Broadcast(name.data(), vtkIdType(name.size()), 0);
    this->Path = name.data();
  }

  // Waits, so that no rank removes files that another rank still reads.
  void TearDown() override { this->Controller->Barrier(); }

  vtkMultiProcessController* const Controller = vtkMultiProcessController::GetGlobalController();
  std::string Path;
  std::unique_ptr<TemporaryFolder> Folder;
};

} // namespace

TEST_P(PipelineOnRanks, MakesTheImageOfOneProcessBitForBit)
{
  Pipeline together(this->Path, this->Controller);
  Pipeline alone(this->Path, nullptr);
  vtkImageData* const image = together.image();
  EXPECT_GT(together.Delaunay->GetOutput()->GetNumberOfCells(), 0);
  ASSERT_EQ(61 * 47, image->GetNumberOfPoints());
  ASSERT_NE(nullptr, image->GetPointData()->GetArray("height"));
  // On several ranks, the image also has ids of cells.
  image->GetPointData()->RemoveArray("GlobalCellIds");
  EXPECT_TRUE(sameArrays(alone.image(), image));
}

INSTANTIATE_TEST_SUITE_P(Sets, PipelineOnRanks, testing::Values("uniform", "clustered", "lattice"));
