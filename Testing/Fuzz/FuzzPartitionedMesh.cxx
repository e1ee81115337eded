// SPDX-License-Identifier: BSD-3-Clause
// Damages the index, the tables and the pieces of a partitioned mesh, corrects their checksums, and
// reads all pieces. This must succeed or throw an IOError. A seed and a number identify a case:
// 'fuzzPartitionedMesh --seed S --case N' repeats it.
#include "ForgedMesh.h"
#include "FuzzDriver.h"
#include "SourceMesh.h"

#include "Files/IOError.h"
#include "Flat/FlatMesh.h"
#include "Partitioned/ReadPiece.h"
#include "Partitioning/PartitionMesh.h"

#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <optional>
#include <random>
#include <string>

namespace
{

namespace fs = std::filesystem;
using namespace tipp;
using Engine = std::mt19937_64;

std::size_t below(Engine& random, std::size_t n)
{
  return n == 0 ? 0 : std::size_t(random() % n);
}

std::uint64_t drawWord(Engine& random)
{
  const std::uint64_t kinds[] = { random() % 4, random() % 100, random(), ~random() % 16,
    std::uint64_t(1) << (random() % 64), ~std::uint64_t(0) - random() % 4 };
  return kinds[below(random, 6)];
}

/// Replaces a number in the text, or a byte.
void damageText(Engine& random, std::string& text)
{
  std::size_t at = below(random, text.size());
  if (below(random, 3) == 0)
  {
    text[at] = char(random());
    return;
  }
  at = text.find_first_of("0123456789", at);
  if (at == std::string::npos)
  {
    return;
  }
  const std::size_t end = text.find_first_not_of("0123456789", at);
  const std::string sign = below(random, 8) == 0 ? "-" : "";
  text.replace(at, std::min(end, text.size()) - at, sign + std::to_string(drawWord(random)));
}

void damageWords(Engine& random, std::string& tables)
{
  const std::uint64_t word = drawWord(random);
  std::memcpy(tables.data() + 8 * below(random, tables.size() / 8), &word, 8);
}

/// Damages ids more often than other bytes, because the reader relies on them.
void damagePiece(Engine& random, test::ForgedMesh& forged)
{
  const std::size_t piece = below(random, forged.pieces());
  const PieceRole roles[] = { PieceRole::PointIds, PieceRole::CellIds, PieceRole::Connectivity,
    PieceRole::PointGhosts };
  const std::size_t array = below(random, 2) == 0 ? below(random, forged.arrays(piece))
                                                  : forged.find(piece, roles[below(random, 4)]);
  const std::size_t words = forged.arrayBytes(piece, array) / 8;
  if (words > 0)
  {
    forged.putWord(piece, array, 8 * below(random, words), drawWord(random));
  }
}

class FuzzedMesh
{
public:
  explicit FuzzedMesh(bool duplicate)
    : Folder(fs::temp_directory_path() /
        ("fuzzPartitionedMesh." + std::to_string(std::random_device()())))
  {
    const std::string flat = (this->Folder / "flat").string();
    fs::create_directories(flat);
    test::SourceMesh source = test::makeSource(latticeTriangles(5, 0.3));
    test::addSeries(source, 2);
    test::writeFlat(source, flat);
    PartitionOptions options;
    options.Tiling = *TilingChoice::parse("grid:2x2");
    options.DuplicateBorrowers = duplicate;
    partitionMesh(openFlatMesh(flat), this->path(), options);
    this->Good.emplace(this->path());
  }
  ~FuzzedMesh() { fs::remove_all(this->Folder); }
  FuzzedMesh(const FuzzedMesh&) = delete;
  FuzzedMesh& operator=(const FuzzedMesh&) = delete;

  /// Whether reading returned a mesh or threw an IOError.
  bool survives(std::uint64_t seed, std::uint64_t number) const
  {
    std::seed_seq both{ seed, number };
    Engine random(both);
    test::ForgedMesh forged = *this->Good;
    if (below(random, 2) == 0)
    {
      damagePiece(random, forged);
    }
    else
    {
      for (std::size_t i = 1 + below(random, 3); i > 0; --i)
      {
        below(random, 2) == 0 ? damageText(random, forged.Index)
                              : damageWords(random, forged.Tables);
      }
    }
    forged.write();
    try
    {
      const PartitionedMesh mesh = openPartitionedMesh(this->path());
      for (std::size_t piece = 0; piece < mesh.Pieces.size(); ++piece)
      {
        readPiece(mesh, piece);
      }
    }
    catch (const IOError&)
    {
      return true;
    }
    catch (const std::exception& error)
    {
      std::printf("case %llu of seed %llu: %s\n", (unsigned long long)number,
        (unsigned long long)seed, error.what());
      return false;
    }
    return true;
  }

private:
  std::string path() const { return (this->Folder / "mesh").string(); }

  fs::path Folder;
  std::optional<test::ForgedMesh> Good;
};

bool passes(std::uint64_t seed, std::uint64_t number)
{
  static const FuzzedMesh byReference(false);
  static const FuzzedMesh duplicated(true);
  return (number % 2 == 0 ? byReference : duplicated).survives(seed, number);
}

} // namespace

int main(int argc, char** argv)
{
  return test::fuzz("fuzzPartitionedMesh", argc, argv, passes);
}
