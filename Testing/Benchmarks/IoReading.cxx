// SPDX-License-Identifier: BSD-3-Clause
// Compares reading partitioned meshes with vtkXMLUnstructuredGridReader on one file of the same
// cells.
#include "IoSubjects.h"

#include "Meshes/MeshFiles.h"
#include "Parallel/ParallelFor.h"
#include "Partitioned/ReadPiece.h"

#include "vtkNew.h"
#include "vtkUnstructuredGrid.h"
#include "vtkXMLUnstructuredGridReader.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>

namespace tipp
{
namespace benchmark
{
namespace
{

double secondsOf(const std::function<void()>& work)
{
  const auto start = std::chrono::steady_clock::now();
  work();
  const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
  return passed.count();
}

/// Seconds of the fastest of `repeat` runs.
double fastest(int repeat, const std::function<void()>& work)
{
  double best = secondsOf(work);
  for (int i = 1; i < repeat; ++i)
  {
    best = std::min(best, secondsOf(work));
  }
  return best;
}

struct Taken
{
  std::int64_t Pieces = 0;
  std::int64_t Cells = 0;
  std::int64_t Bytes = 0;
};

/// Opens the mesh, and makes VTK grids of the owned cells in the pieces that meet a range.
Taken readRange(const std::string& path, const Box3& range, int threads)
{
  const PartitionedMesh mesh = openPartitionedMesh(path);
  std::vector<std::size_t> pieces;
  for (std::size_t i = 0; i < mesh.Pieces.size(); ++i)
  {
    if (projected<2>(mesh.Pieces[i].Extent).meets(projected<2>(range)))
    {
      pieces.push_back(i);
    }
  }
  std::vector<vtkSmartPointer<vtkUnstructuredGrid>> grids(pieces.size());
  std::vector<std::int64_t> bytes(pieces.size());
  PieceOptions options;
  options.Borrowed = false;
  parallelFor(std::int64_t(pieces.size()), threads,
    [&](std::int64_t i)
    {
      Piece piece = readPiece(mesh, pieces[std::size_t(i)], options);
      bytes[std::size_t(i)] = piece.BytesRead;
      grids[std::size_t(i)] = makeGrid(std::move(piece));
    });
  Taken taken;
  taken.Pieces = std::int64_t(pieces.size());
  for (std::size_t i = 0; i < grids.size(); ++i)
  {
    taken.Cells += grids[i]->GetNumberOfCells();
    taken.Bytes += bytes[i];
  }
  return taken;
}

/// The middle of the domain: a tenth of each side, so 1 % of the area.
Box3 middleOf(const Box3& domain)
{
  Box3 range = domain;
  for (std::size_t axis = 0; axis < 2; ++axis)
  {
    range.Min[axis] = domain.Min[axis] + 0.45 * domain.width(axis);
    range.Max[axis] = domain.Min[axis] + 0.55 * domain.width(axis);
  }
  return range;
}

} // namespace

void benchmarkReading(const IoArguments& arguments)
{
  const std::string& vtu = arguments.Meshes[0];
  const std::string& path = arguments.Meshes[1];
  const double vtk = fastest(arguments.Repeat,
    [&]
    {
      vtkNew<vtkXMLUnstructuredGridReader> reader;
      reader->SetFileName(vtu.c_str());
      reader->Update();
    });
  std::printf("vtkXMLUnstructuredGridReader, one .vtu: %.3f s\n", vtk);
  const Box3 all = openPartitionedMesh(path).Domain;
  Taken taken;
  double whole = 0;
  for (const int threads : { 1, arguments.Threads })
  {
    whole = fastest(arguments.Repeat, [&] { taken = readRange(path, all, threads); });
    std::printf("all %lld pieces, %d threads: %.3f s, %.2f x VTK's, %lld cells, %.0f MB\n",
      (long long)taken.Pieces, threads, whole, whole / vtk, (long long)taken.Cells,
      double(taken.Bytes) / 1e6);
  }
  const double part =
    fastest(arguments.Repeat, [&] { taken = readRange(path, middleOf(all), arguments.Threads); });
  std::printf("1 %% of the area, %lld pieces, %d threads: %.4f s, %.1f times faster than all\n",
    (long long)taken.Pieces, arguments.Threads, part, whole / part);
}

void benchmarkBorrowing(const IoArguments& arguments)
{
  const PartitionedMesh lent = openPartitionedMesh(arguments.Meshes[0]);
  const PartitionedMesh copied = openPartitionedMesh(arguments.Meshes[1]);
  const std::size_t number =
    lent.Pieces.size() / 2 + std::size_t(std::sqrt(lent.Pieces.size())) / 2;
  Piece piece;
  const auto measure = [&](const PartitionedMesh& mesh)
  { return fastest(arguments.Repeat, [&] { piece = readPiece(mesh, number); }); };
  const double duplicated = measure(copied);
  const auto least = double(piece.BytesRead);
  const double referred = measure(lent);
  std::printf("piece %zu with borrowed cells, duplicated: %.4f s, %.2f MB\n", number, duplicated,
    least / 1e6);
  std::printf("by reference: %.4f s, %.2f MB, %.3f x the bytes, %.2f x the time\n", referred,
    double(piece.BytesRead) / 1e6, double(piece.BytesRead) / least, referred / duplicated);
}

} // namespace benchmark
} // namespace tipp
