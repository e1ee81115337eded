// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippArrayFiles_h
#define tippArrayFiles_h

#include "Files/InputFile.h"
#include "Flat/RawArray.h"
#include "Loading/VertexLoader.h"

#include <memory>
#include <vector>

namespace tipp
{

/// The ids' least and greatest; Low is above High if there are no ids.
struct IdRange
{
  std::int64_t Low;
  std::int64_t High;
};

/// Arrays of equally many tuples with their files open, and what all loaders do with them.
class ArrayFiles
{
public:
  /// Throws as makeVertexLoader does.
  explicit ArrayFiles(std::vector<RawArray> arrays);

  std::size_t count() const { return this->Arrays.size(); }
  const RawArray& array(std::size_t a) const { return this->Arrays[a]; }
  const InputFile& file(std::size_t a) const { return *this->Files[a]; }
  std::size_t tupleBytes(std::size_t a) const { return this->Arrays[a].tupleBytes(); }
  std::int64_t tuples() const { return this->Tuples; }
  /// Of one tuple of every array.
  std::size_t recordBytes() const { return this->RecordBytes; }

  /// Throws IOError that names an id which is not that of a tuple.
  IdRange range(const std::int64_t* ids, std::size_t count, int threads) const;

  /// Tuples of one array that follow each other, and counts that as a read. Of very many tuples
  /// each thread reads a part: where files are cached, reading is copying.
  void read(std::size_t a, std::int64_t first, std::int64_t tuples, void* to, int threads,
    LoadCounters& counters) const;

private:
  std::vector<RawArray> Arrays;
  std::vector<std::shared_ptr<InputFile>> Files;
  std::int64_t Tuples = 0;
  std::size_t RecordBytes = 0;
};

/// Memory for some tuples of every array.
class TupleBuffers
{
public:
  void resize(const ArrayFiles& files, std::int64_t tuples);
  char* data(std::size_t a) { return this->Buffers[a].get(); }

private:
  std::vector<std::unique_ptr<char[]>> Buffers;
  std::int64_t Tuples = 0;
};

} // namespace tipp

#endif
