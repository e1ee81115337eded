// SPDX-License-Identifier: BSD-3-Clause
#include "InMemory/AlphaShape.h"

#include "vtkNew.h"
#include "vtkPoints.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace
{

using namespace tipp;

/// A small triangle 0 1 2, and two large ones beside it, the second with a short edge 3 4.
class AlphaShapeTest : public testing::Test
{
public:
  AlphaShapeTest()
  {
    for (const auto& p : { std::array<double, 2>{ 0, 0 }, { 1, 0 }, { 0, 1 }, { 9, 9 }, { 10, 9 } })
    {
      this->Points->InsertNextPoint(p[0], p[1], 0);
    }
  }

  template <typename Id>
  static Buffer<Id> triangles()
  {
    const Id ids[] = { 0, 1, 2, 1, 3, 2, 1, 4, 3 };
    Buffer<Id> buffer(9);
    std::copy(std::begin(ids), std::end(ids), buffer.begin());
    return buffer;
  }

  PointAt pointAt() const
  {
    return [this](PointId id, double* p) { this->Points->GetPoint(vtkIdType(id), p); };
  }

  AlphaShape<std::int32_t> shape(double alpha) const
  {
    return alphaShape(triangles<std::int32_t>(), this->pointAt(), alpha, std::vector<char>(5, 0));
  }

  template <typename Id>
  static std::vector<std::int64_t> list(const Buffer<Id>& ids)
  {
    return { ids.begin(), ids.end() };
  }

  vtkNew<vtkPoints> Points;
};

using List = std::vector<std::int64_t>;

TEST_F(AlphaShapeTest, SmallTrianglesStayInTheirOrder)
{
  EXPECT_EQ((List{ 0, 1, 2 }), list(this->shape(0.8).Triangles));
  EXPECT_EQ((List{ 0, 1, 2, 1, 3, 2, 1, 4, 3 }), list(this->shape(1000).Triangles));
}

TEST_F(AlphaShapeTest, ShortEdgesOutsideTrianglesAreLines)
{
  EXPECT_EQ((List{ 3, 4 }), list(this->shape(0.8).Lines));
  EXPECT_TRUE(this->shape(0.8).Vertices.empty());
}

TEST_F(AlphaShapeTest, EdgesBetweenDroppedTrianglesAppearOnce)
{
  // The circumradius of 0 1 2 is 0.707. Its edges 0 1 and 0 2 have length 1, and 1 2 has 1.41.
  const auto shape = this->shape(0.6);
  EXPECT_TRUE(shape.Triangles.empty());
  EXPECT_EQ((List{ 0, 1, 0, 2, 3, 4 }), list(shape.Lines));
}

TEST_F(AlphaShapeTest, UncoveredPointsAreVertices)
{
  const auto shape = this->shape(0.1);
  EXPECT_TRUE(shape.Triangles.empty());
  EXPECT_TRUE(shape.Lines.empty());
  EXPECT_EQ((List{ 0, 1, 2, 3, 4 }), list(shape.Vertices));
}

TEST_F(AlphaShapeTest, CoveredPointsAreNoVertices)
{
  const auto shape = alphaShape(triangles<std::int32_t>(), this->pointAt(), 0.1, { 0, 1, 0, 0, 1 });
  EXPECT_EQ((List{ 0, 2, 3 }), list(shape.Vertices));
}

TEST_F(AlphaShapeTest, IdsOfEitherSizeGiveTheSameShape)
{
  const auto wide =
    alphaShape(triangles<std::int64_t>(), this->pointAt(), 0.6, std::vector<char>(5, 0));
  EXPECT_EQ(list(this->shape(0.6).Lines), list(wide.Lines));
}

TEST_F(AlphaShapeTest, ATriangleWithoutAreaIsInfinitelyLarge)
{
  this->Points->SetPoint(2, 2, 0, 0);
  EXPECT_EQ(List{},
    list(alphaShape(triangles<std::int32_t>(), this->pointAt(), 1.2, std::vector<char>(5, 0))
           .Triangles));
}

} // namespace
