// SPDX-License-Identifier: BSD-3-Clause
#include "Las/CopcHierarchy.h"

#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Files/RawValues.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace tipp
{
namespace
{

[[noreturn]] void refuseHierarchy(const std::string& path, const std::string& problem)
{
  throw IOError(path,
    "has a damaged COPC hierarchy: " + problem +
      "; copy it again, or convert it to .las, which is read without the hierarchy.");
}

/// A cube of the octree.
struct CopcCube
{
  std::int32_t Level = 0;
  std::array<std::int32_t, 3> Position{};

  bool isValid() const
  {
    const auto isInside = [this](std::int32_t at)
    { return at >= 0 && at < (std::int64_t(1) << this->Level); };
    return this->Level >= 0 && this->Level <= LastCopcLevel &&
      std::all_of(this->Position.begin(), this->Position.end(), isInside);
  }

  /// Whether this cube is `other` or a part of it.
  bool isWithin(const CopcCube& other) const
  {
    const int levels = this->Level - other.Level;
    bool isInside = levels >= 0;
    for (std::size_t axis = 0; isInside && axis < 3; ++axis)
    {
      isInside = this->Position[axis] >> levels == other.Position[axis];
    }
    return isInside;
  }

  std::string text() const
  {
    std::string text = std::to_string(this->Level);
    for (const std::int32_t at : this->Position)
    {
      text += "-" + std::to_string(at);
    }
    return text;
  }

  Box3 bounds(const CopcInfo& info) const
  {
    const double side = std::ldexp(2 * info.HalfSize, -this->Level);
    Box3 box;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      box.Min[axis] = info.Centre[axis] - info.HalfSize + side * this->Position[axis];
      box.Max[axis] = box.Min[axis] + side;
    }
    return box;
  }
};

/// An entry of a page: a node, or another page that has its part of the hierarchy.
struct CopcEntry
{
  static constexpr std::size_t Bytes = 32;
  static constexpr std::int32_t Page = -1; ///< Points of a page

  explicit CopcEntry(const char* bytes)
    : Offset(valueAt<std::uint64_t>(bytes + 16))
    , Size(valueAt<std::int32_t>(bytes + 24))
    , Points(valueAt<std::int32_t>(bytes + 28))
  {
    this->At.Level = valueAt<std::int32_t>(bytes);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      this->At.Position[axis] = valueAt<std::int32_t>(bytes + 4 + 4 * axis);
    }
  }

  CopcCube At;
  std::uint64_t Offset;
  std::int64_t Size; ///< in bytes
  std::int64_t Points;
};

/// Reads the pages, from that of the root on.
class HierarchyReader
{
public:
  HierarchyReader(const std::string& path, const LasHeader& header, const CopcInfo& info,
    const std::vector<LazChunkPlace>& chunks, const CopcRequest& request)
    : File(path)
    , Info(info)
    , Chunks(chunks)
    , Region(request.Region)
    , LastLevel(info.levelFor(request.Spacing))
    , IsNode(chunks.size(), false)
  {
    for (std::size_t axis = 0; axis < 2; ++axis)
    {
      // Coordinates may have been rounded after the points were sorted into cubes.
      this->Slack[axis] =
        std::fabs(header.Scale[axis]) + 1e-14 * (std::fabs(info.Centre[axis]) + 2 * info.HalfSize);
    }
  }

  std::vector<CopcNode> read()
  {
    this->addPage(CopcCube(), this->Info.RootOffset, this->Info.RootBytes);
    while (!this->Pages.empty())
    {
      const Page page = this->Pages.back();
      this->Pages.pop_back();
      this->File.readBlocks(page.Offset, page.Bytes,
        [&](const char* bytes, std::size_t count)
        {
          for (std::size_t at = 0; at < count; at += CopcEntry::Bytes)
          {
            this->take(page, CopcEntry(bytes + at));
          }
        });
    }
    this->requireWhole();
    std::sort(this->Found.begin(), this->Found.end(),
      [](const CopcNode& a, const CopcNode& b) { return a.Chunk < b.Chunk; });
    return std::move(this->Found);
  }

private:
  struct Page
  {
    CopcCube Root;
    std::uint64_t Offset;
    std::uint64_t Bytes;
  };

  void addPage(const CopcCube& root, std::uint64_t offset, std::uint64_t bytes)
  {
    const std::string name = "the page at byte " + std::to_string(offset);
    if (bytes == 0 || bytes % CopcEntry::Bytes != 0 || offset > this->File.size() ||
      bytes > this->File.size() - offset)
    {
      refuseHierarchy(this->File.path(),
        name + " has " + std::to_string(bytes) +
          " bytes, which are not whole entries or not in the file");
    }
    // Also bounds the work: pages can neither form a circle nor overlap again and again.
    this->PageBytes += bytes;
    if (!this->PageOffsets.insert(offset).second || this->PageBytes > this->File.size())
    {
      refuseHierarchy(this->File.path(), name + " is there more than once");
    }
    this->Pages.push_back({ root, offset, bytes });
  }

  void take(const Page& page, const CopcEntry& entry)
  {
    if (!entry.At.isValid() || !entry.At.isWithin(page.Root))
    {
      refuseHierarchy(this->File.path(),
        "the page of node " + page.Root.text() + " has a node " + entry.At.text() +
          ", which is no part of it");
    }
    const bool isWanted = entry.At.Level <= this->LastLevel && this->meetsRegion(entry.At);
    if (entry.Points == CopcEntry::Page && !isWanted)
    {
      this->IsWhole = false;
    }
    else if (entry.Points == CopcEntry::Page)
    {
      this->addPage(entry.At, entry.Offset, std::uint64_t(std::max<std::int64_t>(entry.Size, 0)));
    }
    else if (entry.Points != 0)
    {
      const std::size_t chunk = this->chunkOf(entry);
      if (isWanted)
      {
        this->Found.push_back(
          { entry.At.Level, entry.At.Position, chunk, std::uint64_t(entry.Points) });
      }
    }
  }

  bool meetsRegion(const CopcCube& cube) const
  {
    Box2 box = projected<2>(cube.bounds(this->Info));
    for (std::size_t axis = 0; axis < 2; ++axis)
    {
      box.Min[axis] -= this->Slack[axis];
      box.Max[axis] += this->Slack[axis];
    }
    return !this->Region || this->Region->meets(box);
  }

  /// Returns the index of a node's chunk.
  std::size_t chunkOf(const CopcEntry& entry)
  {
    const auto chunk = std::lower_bound(this->Chunks.begin(), this->Chunks.end(), entry.Offset,
      [](const LazChunkPlace& place, std::uint64_t offset) { return place.Begin < offset; });
    if (chunk == this->Chunks.end() || chunk->Begin != entry.Offset ||
      std::int64_t(chunk->Bytes) != entry.Size || std::int64_t(chunk->Points) != entry.Points)
    {
      refuseHierarchy(this->File.path(),
        "node " + entry.At.text() + " has " + std::to_string(entry.Points) + " points in " +
          std::to_string(entry.Size) + " bytes at byte " + std::to_string(entry.Offset) +
          ", where there is no such chunk of points");
    }
    const auto index = std::size_t(chunk - this->Chunks.begin());
    if (this->IsNode[index])
    {
      refuseHierarchy(
        this->File.path(), "node " + entry.At.text() + " has the same points as another node");
    }
    this->IsNode[index] = true;
    return index;
  }

  /// Throws if all pages have been read, and chunks are missing in them.
  void requireWhole() const
  {
    const auto missing = std::count(this->IsNode.begin(), this->IsNode.end(), false);
    if (this->IsWhole && missing > 0)
    {
      refuseHierarchy(this->File.path(),
        std::to_string(missing) + " of the " + std::to_string(this->IsNode.size()) +
          " chunks of points are in no node");
    }
  }

  const InputFile File;
  const CopcInfo Info;
  const std::vector<LazChunkPlace>& Chunks;
  const std::optional<Box2> Region;
  const int LastLevel;
  std::array<double, 2> Slack{};
  std::vector<Page> Pages; ///< to read
  std::set<std::uint64_t> PageOffsets;
  std::uint64_t PageBytes = 0;
  bool IsWhole = true;      ///< no page is left out
  std::vector<bool> IsNode; ///< by chunk
  std::vector<CopcNode> Found;
};

} // namespace

Box3 CopcInfo::bounds() const
{
  return CopcCube().bounds(*this);
}

int CopcInfo::levelFor(double spacing) const
{
  int level = 0;
  while (level < LastCopcLevel && !(std::ldexp(this->Spacing, -level) <= spacing))
  {
    ++level;
  }
  return level;
}

Box3 CopcNode::bounds(const CopcInfo& info) const
{
  return CopcCube{ this->Level, this->Position }.bounds(info);
}

CopcInfo readCopcInfo(const std::string& path, const LasHeader& header)
{
  constexpr std::size_t size = 160;
  if (header.Copc.size() < size)
  {
    refuseHierarchy(
      path, "its record has " + std::to_string(header.Copc.size()) + " bytes instead of 160");
  }
  const char* const bytes = header.Copc.data();
  CopcInfo info;
  bool isFinite = true;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    info.Centre[axis] = valueAt<double>(bytes + 8 * axis);
    isFinite = isFinite && std::isfinite(info.Centre[axis]);
  }
  info.HalfSize = valueAt<double>(bytes + 24);
  info.Spacing = valueAt<double>(bytes + 32);
  info.RootOffset = valueAt<std::uint64_t>(bytes + 40);
  info.RootBytes = valueAt<std::uint64_t>(bytes + 48);
  constexpr double most = 1e300; // so that sums are finite
  if (!isFinite || !(info.HalfSize > 0 && info.HalfSize < most) ||
    !(info.Spacing > 0 && info.Spacing < most))
  {
    refuseHierarchy(path, "its record has no usable centre, size or spacing");
  }
  return info;
}

std::vector<CopcNode> findCopcNodes(const std::string& path, const LasHeader& header,
  const std::vector<LazChunkPlace>& chunks, const CopcRequest& request)
{
  return HierarchyReader(path, header, readCopcInfo(path, header), chunks, request).read();
}

} // namespace tipp
