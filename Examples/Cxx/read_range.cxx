// Reads the cells of a mesh that meet a range: read_range MESH X0 X1 Y0 Y1
#include <vtkNew.h>
#include <vtkPartitionedUnstructuredReader.h>
#include <vtkUnstructuredGrid.h>

#include <cstdlib>
#include <iostream>

int main(int argc, char* argv[])
{
  if (argc != 6)
  {
    std::cerr << "usage: read_range MESH X0 X1 Y0 Y1\n";
    return EXIT_FAILURE;
  }
  vtkNew<vtkPartitionedUnstructuredReader> reader;
  reader->SetFileName(argv[1]);
  reader->SetBounds(
    std::atof(argv[2]), std::atof(argv[3]), std::atof(argv[4]), std::atof(argv[5]), 0, 0);
  reader->Update();

  auto* mesh = vtkUnstructuredGrid::SafeDownCast(reader->GetOutputDataObject(0));
  std::cout << mesh->GetNumberOfCells() << " cells of " << reader->GetNumberOfPiecesRead()
            << " pieces\n";
  return EXIT_SUCCESS;
}
