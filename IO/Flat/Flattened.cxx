// SPDX-License-Identifier: BSD-3-Clause
#include "Flat/Flattened.h"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <utility>

namespace tipp
{
namespace
{

using Ids = std::vector<std::int64_t>;

constexpr const char* parentName = "vtkOriginalCellIds";

/// Copies the tuples of the parent cells, in the order of `parents`.
FlatArray gathered(const FlatArray& all, const Ids& parents)
{
  FlatArray some = all;
  const std::size_t bytes = std::size_t(all.Components) * scalarSize(all.Type);
  const auto values = std::make_shared<std::vector<char>>(parents.size() * bytes);
  const auto* const from = static_cast<const char*>(all.Values);
  for (std::size_t i = 0; i < parents.size(); ++i)
  {
    const char* const tuple = from + std::size_t(parents[i]) * bytes;
    std::copy(tuple, tuple + bytes, values->data() + i * bytes);
  }
  some.Tuples = std::int64_t(parents.size());
  some.Values = values->data();
  some.Owner = values;
  return some;
}

FlatArray parentArray(Ids parents)
{
  const auto values = std::make_shared<Ids>(std::move(parents));
  const auto count = std::int64_t(values->size());
  return { parentName, Scalar::Int64, 1, count, 0, values->data(), values };
}

} // namespace

void setCellData(Flattened& flattened, std::vector<FlatArray> arrays, Ids parents)
{
  const bool changed = flattened.areCellsChanged();
  bool named = false;
  for (FlatArray& array : arrays)
  {
    array = changed ? gathered(array, parents) : array;
    named = named || array.Name == parentName;
  }
  if (changed && !named)
  {
    arrays.push_back(parentArray(std::move(parents)));
  }
  flattened.Content.CellData = std::move(arrays);
}

} // namespace tipp
