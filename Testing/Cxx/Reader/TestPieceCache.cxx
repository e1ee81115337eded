// SPDX-License-Identifier: BSD-3-Clause
#include "Reading/PieceSource.h"

#include <gtest/gtest.h>

using tipp::Piece;
using tipp::PieceCache;

namespace
{

PieceCache::Key keyOf(std::size_t number)
{
  return { number, false, { true }, 0 };
}

TEST(PieceCache, ReturnsPiecesReadWithTheSameSelectionOnly)
{
  PieceCache cache;
  const auto piece = std::make_shared<const Piece>();
  cache.keep(keyOf(3), piece);
  EXPECT_EQ(piece, cache.find(keyOf(3)));
  EXPECT_EQ(nullptr, cache.find(keyOf(4)));
  EXPECT_EQ(nullptr, cache.find({ 3, true, { true }, 0 }));
  EXPECT_EQ(nullptr, cache.find({ 3, false, { false }, 0 }));
  EXPECT_EQ(nullptr, cache.find({ 3, false, { true }, 1 }));
}

TEST(PieceCache, DropsTheLeastRecentlyUsedPiece)
{
  PieceCache cache;
  for (std::size_t number = 0; number < 3; ++number)
  {
    cache.keep(keyOf(number), std::make_shared<const Piece>());
  }
  EXPECT_NE(nullptr, cache.find(keyOf(0)));
  cache.shrink(2);
  EXPECT_NE(nullptr, cache.find(keyOf(0)));
  EXPECT_EQ(nullptr, cache.find(keyOf(1)));
  EXPECT_NE(nullptr, cache.find(keyOf(2)));
  cache.clear();
  EXPECT_EQ(nullptr, cache.find(keyOf(0)));
}

} // namespace
