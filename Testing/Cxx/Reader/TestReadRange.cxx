// SPDX-License-Identifier: BSD-3-Clause
#include "Flat/FlatMesh.h"
#include "Partitioning/PartitionMesh.h"
#include "ReaderTesting.h"
#include "TemporaryFolder.h"

namespace
{

using tipp::test::Content;
using tipp::test::contentOf;
using tipp::test::SmallMesh;
using Vector = std::array<std::int64_t, 3>;

Vector minus(const Vector& a, const Vector& b)
{
  return { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
}

Vector cross(const Vector& a, const Vector& b)
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}

std::int64_t dot(const Vector& a, const Vector& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

bool areApartAlong(const Vector& axis, const std::vector<Vector>& a, const std::vector<Vector>& b)
{
  const auto range = [&axis](const std::vector<Vector>& points)
  {
    std::pair<std::int64_t, std::int64_t> r{ INT64_MAX, INT64_MIN };
    for (const Vector& p : points)
    {
      r = { std::min(r.first, dot(axis, p)), std::max(r.second, dot(axis, p)) };
    }
    return r;
  };
  const auto ra = range(a);
  const auto rb = range(b);
  return ra.first > rb.second || rb.first > ra.second;
}

/// Whether two convex hulls share a point, tested with all possible separating axes. Exact for
/// integer coordinates.
bool hullsMeet(const std::vector<Vector>& a, const std::vector<Vector>& b, bool plane)
{
  const std::vector<Vector> units{ { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };
  std::vector<Vector> axes = units;
  std::vector<Vector> edges;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    for (std::size_t j = 0; j < i; ++j)
    {
      edges.push_back(minus(a[i], a[j]));
    }
  }
  for (const Vector& edge : edges)
  {
    if (plane)
    {
      axes.push_back({ -edge[1], edge[0], 0 });
      continue;
    }
    for (const Vector& unit : units)
    {
      axes.push_back(cross(edge, unit));
    }
    for (const Vector& other : edges)
    {
      axes.push_back(cross(edge, other));
    }
  }
  return std::none_of(
    axes.begin(), axes.end(), [&](const Vector& axis) { return areApartAlong(axis, a, b); });
}

class ReadRange : public testing::TestWithParam<int>
{
protected:
  ReadRange()
    : Mesh(tipp::test::makeMesh(GetParam(), GetParam() == 3 ? 14 : 6))
  {
    tipp::test::writeMesh(this->Mesh, this->Folder.path("flat"));
    tipp::PartitionOptions options;
    options.Tiling = *tipp::TilingChoice::parse("grid:3x2x2");
    tipp::partitionMesh(
      tipp::openFlatMesh(this->Folder.path("flat")), this->Folder.path("stored"), options);
  }

  /// The cells that meet the range, by a test of all cells of the source.
  std::vector<std::int64_t> expected(const std::array<int, 6>& range) const
  {
    const bool plane = this->Mesh.CellSize == 3;
    std::vector<Vector> box;
    for (int c = 0; c < 8; ++c)
    {
      box.push_back({ range[std::size_t(c & 1)], range[std::size_t(2 + (c >> 1 & 1))],
        plane ? 0 : range[std::size_t(4 + (c >> 2))] });
    }
    std::vector<std::int64_t> found;
    for (std::size_t cell = 0; cell < this->Mesh.cellCount(); ++cell)
    {
      std::vector<Vector> corners;
      for (std::size_t c = 0; c < std::size_t(this->Mesh.CellSize); ++c)
      {
        const std::int64_t id = this->Mesh.Cells[cell * std::size_t(this->Mesh.CellSize) + c];
        const double* const p = this->Mesh.Points.data() + 3 * id;
        corners.push_back(
          { std::int64_t(p[0]), std::int64_t(p[1]), plane ? 0 : std::int64_t(p[2]) });
      }
      if (hullsMeet(corners, box, plane))
      {
        found.push_back(std::int64_t(cell));
      }
    }
    return found;
  }

  void setRange(vtkPartitionedUnstructuredReader* reader, const char* form,
    const std::array<int, 6>& range) const
  {
    reader->SetController(nullptr);
    reader->SetFileName(this->Folder.path(form).c_str());
    reader->SetTiling("grid:3x2x2");
    const double bounds[] = { double(range[0]), double(range[1]), double(range[2]),
      double(range[3]), double(range[4]), double(range[5]) };
    reader->SetBounds(bounds);
  }

  const tipp::test::TemporaryFolder Folder;
  const SmallMesh Mesh;
};

std::vector<std::array<int, 6>> ranges()
{
  std::mt19937 random(9);
  // A point, a line through a partition's border, the whole domain, and a range outside it.
  std::vector<std::array<int, 6>> all{ { 30, 30, 30, 30, 30, 30 }, { 0, 160, 41, 41, 20, 20 },
    { -10, 1000, -10, 1000, -10, 1000 }, { 500, 600, 500, 600, 500, 600 } };
  for (int i = 0; i < 25; ++i)
  {
    std::array<int, 6> range{};
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      range[2 * axis] = int(random() % 100);
      range[2 * axis + 1] = range[2 * axis] + int(random() % 60);
    }
    all.push_back(range);
  }
  return all;
}

} // namespace

TEST_P(ReadRange, EqualsABruteForceFilter)
{
  for (const auto& range : ranges())
  {
    for (const char* const form : { "flat", "stored" })
    {
      vtkNew<vtkPartitionedUnstructuredReader> reader;
      this->setRange(reader, form, range);
      reader->Update();
      std::vector<std::int64_t> found;
      const Content content =
        contentOf(vtkUnstructuredGrid::SafeDownCast(reader->GetOutputDataObject(0)));
      for (const auto& [id, cell] : content.Cells)
      {
        found.push_back(id);
        EXPECT_EQ(0, cell.Ghost);
      }
      EXPECT_EQ(this->expected(range), found);
    }
  }
}

TEST_P(ReadRange, EachCellIsInOnePiece)
{
  for (const auto& range : ranges())
  {
    for (const int mode : { 0, 1 })
    {
      std::vector<std::int64_t> found;
      for (int piece = 0; piece < 5; ++piece)
      {
        vtkNew<vtkPartitionedUnstructuredReader> reader;
        this->setRange(reader, "stored", range);
        reader->SetBorrowerMode(mode);
        reader->UpdatePiece(piece, 5, 0);
        const Content content =
          contentOf(vtkUnstructuredGrid::SafeDownCast(reader->GetOutputDataObject(0)));
        for (const auto& [id, cell] : content.Cells)
        {
          if (cell.Ghost == 0)
          {
            found.push_back(id);
          }
        }
      }
      std::sort(found.begin(), found.end());
      EXPECT_EQ(this->expected(range), found);
    }
  }
}

TEST_P(ReadRange, OpensOnlyThePiecesThatItMeets)
{
  vtkNew<vtkPartitionedUnstructuredReader> reader;
  this->setRange(reader, "stored", { 2, 3, 2, 3, 2, 3 });
  reader->Update();
  EXPECT_EQ(1, reader->GetNumberOfPiecesRead());
}

INSTANTIATE_TEST_SUITE_P(Dimension, ReadRange, testing::Values(3, 4),
  [](const auto& info) { return info.param == 3 ? "Triangles" : "Tetrahedra"; });
