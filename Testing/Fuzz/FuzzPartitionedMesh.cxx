// SPDX-License-Identifier: BSD-3-Clause
// Damages the index and the tables of a partitioned mesh, gives them right checksums, and reads all
// pieces: that works or ends with an IOError, and nothing else. A case is known by its number and
// the seed: 'fuzzPartitionedMesh --seed S --case N' repeats one.
#include "SourceMesh.h"

#include "Files/IOError.h"
#include "Flat/FlatMesh.h"
#include "Partitioned/Checksum.h"
#include "Partitioned/ReadPiece.h"
#include "Partitioning/PartitionMesh.h"

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>

namespace
{

namespace fs = std::filesystem;
using namespace tipp;
using Engine = std::mt19937_64;

std::string read(const fs::path& path)
{
  std::ifstream file(path, std::ios::binary);
  return { std::istreambuf_iterator<char>(file), {} };
}

void write(const fs::path& path, const std::string& content)
{
  std::ofstream(path, std::ios::binary) << content;
}

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

/// A number in the text becomes another, or a byte does.
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

/// Gives each piece's table, and then the index, a right checksum.
std::string withChecksums(std::string index, const std::string& tables)
{
  std::size_t at = 0;
  while ((at = index.find("\"table\":[", at)) != std::string::npos)
  {
    char* end = nullptr;
    const std::uint64_t offset = std::strtoull(index.c_str() + at + 9, &end, 10);
    const std::uint64_t bytes = std::strtoull(end + 1, nullptr, 10);
    const std::size_t name = index.find("\"table_xxh3\":\"", at);
    if (name != std::string::npos && offset <= tables.size() && bytes <= tables.size() - offset)
    {
      index.replace(name + 14, 16, checksumText(checksumOf(tables.data() + offset, bytes)));
    }
    ++at;
  }
  const std::size_t tail = std::min(index.rfind(",\n\"xxh3\""), index.size());
  return index.substr(0, tail) + ",\n\"xxh3\": \"" + checksumText(checksumOf(index.data(), tail)) +
    "\"\n}\n";
}

class Meshes
{
public:
  Meshes()
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
    partitionMesh(openFlatMesh(flat), this->path(), options);
    this->Index = read(this->path() + "/index.json");
    this->Tables = read(this->path() + "/tables.bin");
  }
  ~Meshes() { fs::remove_all(this->Folder); }
  Meshes(const Meshes&) = delete;
  Meshes& operator=(const Meshes&) = delete;

  /// Whether all that came out was a mesh or an IOError.
  bool survives(std::uint64_t seed, std::uint64_t number) const
  {
    std::seed_seq both{ seed, number };
    Engine random(both);
    std::string index = this->Index;
    std::string tables = this->Tables;
    for (std::size_t i = 1 + below(random, 3); i > 0; --i)
    {
      below(random, 2) == 0 ? damageText(random, index) : damageWords(random, tables);
    }
    write(this->path() + "/index.json", withChecksums(index, tables));
    write(this->path() + "/tables.bin", tables);
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
  std::string Index;
  std::string Tables;
};

int usage()
{
  std::fputs("usage: fuzzPartitionedMesh [--seconds N] [--seed S] [--case N]\n", stderr);
  return 2;
}

} // namespace

int main(int argc, char** argv)
{
  double seconds = 60;
  std::uint64_t seed = 1;
  double only = -1;
  for (int i = 1; i < argc; i += 2)
  {
    char* end = nullptr;
    const double value = i + 1 < argc ? std::strtod(argv[i + 1], &end) : -1;
    if (!(value >= 0) || *end != 0)
    {
      return usage();
    }
    if (std::strcmp(argv[i], "--seconds") == 0)
    {
      seconds = value;
    }
    else if (std::strcmp(argv[i], "--seed") == 0)
    {
      seed = std::uint64_t(value);
    }
    else if (std::strcmp(argv[i], "--case") == 0)
    {
      only = value;
    }
    else
    {
      return usage();
    }
  }
  const Meshes meshes;
  if (only >= 0)
  {
    return meshes.survives(seed, std::uint64_t(only)) ? 0 : 1;
  }
  const auto now = [] { return std::chrono::steady_clock::now(); };
  const auto end = now() + std::chrono::duration<double>(seconds);
  std::uint64_t cases = 0;
  std::uint64_t failures = 0;
  for (; now() < end && failures < 10; ++cases)
  {
    failures += meshes.survives(seed, cases) ? 0 : 1;
  }
  std::printf("%llu cases of seed %llu, %llu failures\n", (unsigned long long)cases,
    (unsigned long long)seed, (unsigned long long)failures);
  return failures == 0 ? 0 : 1;
}
