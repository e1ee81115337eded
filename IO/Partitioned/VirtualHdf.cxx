// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioned/VirtualHdf.h"

#include "Files/OutputFile.h"
#include "Partitioned/PiecesHdf.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace tipp
{
namespace
{

/// A virtual array whose sources are arrays of pieces, in a tree of virtual arrays: HDF5 looks at
/// all sources of an array for each read, and would need the square of the number of pieces.
class VirtualTree
{
public:
  /// `name`: of the groups of the tree's arrays, and different from those of other trees.
  /// `flush`: called after objects were added.
  VirtualTree(
    HdfObjects& objects, const std::function<void()>& flush, HdfShape shape, std::string name)
    : Objects(objects)
    , Flush(flush)
    , Shape(std::move(shape))
    , Name(std::move(name))
  {
  }

  /// Sources must be added in ascending order.
  void add(HdfSource source, std::size_t level = 0)
  {
    this->Levels.resize(std::max(this->Levels.size(), level + 1));
    this->Levels[level].Sources.push_back(std::move(source));
    if (this->Levels[level].Sources.size() == mostSources)
    {
      this->close(level);
    }
  }

  /// Returns the root array. Appends the groups of the others.
  HdfAddress finish(std::vector<HdfLink>& groups)
  {
    for (std::size_t level = 0; level + 1 < this->Levels.size(); ++level)
    {
      this->close(level);
    }
    const HdfAddress root = this->Objects.addVirtualArray(
      this->Shape, this->Levels.empty() ? std::vector<HdfSource>() : this->Levels.back().Sources);
    for (std::size_t level = 0; level < this->Levels.size(); ++level)
    {
      std::vector<HdfLink> parts;
      for (const std::vector<HdfLink>& links : this->Levels[level].Arrays)
      {
        parts.push_back({ std::to_string(parts.size()), this->Objects.addGroup(links) });
      }
      if (!parts.empty())
      {
        groups.push_back({ this->nameOf(level), this->Objects.addGroup(parts) });
      }
    }
    this->Flush();
    return root;
  }

private:
  static constexpr std::size_t mostSources = 128;

  struct Level
  {
    std::vector<HdfSource> Sources;           ///< of the next array
    std::vector<std::vector<HdfLink>> Arrays; ///< that are complete, in groups of equal size
  };

  std::string nameOf(std::size_t level) const { return this->Name + "." + std::to_string(level); }

  /// Makes an array of a level's sources, which is a source of the next level.
  void close(std::size_t level)
  {
    std::vector<HdfSource> sources = std::exchange(this->Levels[level].Sources, {});
    if (sources.empty())
    {
      return;
    }
    const std::uint64_t first = sources.front().First;
    HdfShape shape = this->Shape;
    shape.Sizes[0] = sources.back().First + sources.back().Count - first;
    for (HdfSource& source : sources)
    {
      source.First -= first;
    }
    std::vector<std::vector<HdfLink>>& arrays = this->Levels[level].Arrays;
    if (arrays.empty() || arrays.back().size() == mostSources)
    {
      arrays.emplace_back();
    }
    const std::string number = std::to_string(arrays.back().size());
    const std::string path =
      "/" + this->nameOf(level) + "/" + std::to_string(arrays.size() - 1) + "/" + number;
    arrays.back().push_back({ number, this->Objects.addVirtualArray(shape, sources) });
    this->Flush();
    this->add({ ".", path, first, shape.Sizes[0] }, level + 1);
  }

  HdfObjects& Objects;
  const std::function<void()>& Flush;
  const HdfShape Shape;
  const std::string Name;
  std::vector<Level> Levels;
};

class VirtualHdfWriter : public PiecesHdf
{
public:
  explicit VirtualHdfWriter(const PartitionedMesh& mesh)
    : PiecesHdf(mesh)
    , File(mesh.vtkHdfPath())
  {
  }

  void write()
  {
    const HdfAddress root = this->addAll();
    this->flush(0);
    const std::string superblock = HdfObjects::superblock(0, this->Written, root);
    this->File.write(0, superblock.data(), superblock.size());
    this->File.sync();
    this->File.close();
  }

protected:
  HdfAddress addColumn(const HdfColumn& column) override
  {
    const std::function<void()> flush = [this] { this->flush(std::size_t(1) << 20); };
    VirtualTree tree(this->Objects, flush, this->shapeOf(column),
      "Parts of " + std::to_string(column.Steps.front()));
    std::uint64_t first = 0;
    for (const std::size_t step : column.Steps)
    {
      for (std::size_t i = 0; i < this->Mesh.Pieces.size(); ++i)
      {
        const std::uint64_t tuples = this->tuplesOf(this->Mesh.Pieces[i], column);
        first += leadOf(column); // zeros, as all that has no source
        if (tuples > 0)
        {
          tree.add({ pieceName(i), hdfNameOf(step), first, tuples });
        }
        first += tuples;
      }
    }
    return tree.finish(this->Root);
  }

private:
  /// Writes the objects so far if they take more memory than that.
  void flush(std::size_t most)
  {
    if (this->Objects.end() - this->Written > most)
    {
      const std::string bytes = this->Objects.take();
      this->File.write(this->Written, bytes.data(), bytes.size());
      this->Written += bytes.size();
    }
  }

  OutputFile File;
  std::uint64_t Written = 0;
};

} // namespace

void writeVirtualHdf(const PartitionedMesh& mesh)
{
  VirtualHdfWriter(mesh).write();
}

void requirePiecesOf(const std::string& vtkHdf)
{
  std::error_code ignored;
  const std::filesystem::path path = std::filesystem::canonical(vtkHdf, ignored); // behind links
  const std::string folder = path.has_parent_path() ? path.parent_path().string() : ".";
  if (path.filename() == "mesh.vtkhdf" && isPartitionedMesh(folder))
  {
    verifyViews(openPartitionedMesh(folder));
  }
}

void requireCellType(const std::string& vtkHdf, unsigned char type)
{
  if (type == 0)
  {
    throw IOError(vtkHdf,
      "has cells without a type, as where a file that it refers to is missing or cut; keep it in "
      "the folder of its partitioned mesh, or make a file of its own by 'tipp flatten'.");
  }
}

} // namespace tipp
