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

/// The least and greatest id; Low > High if there are no ids.
struct IdRange
{
  std::int64_t Low;
  std::int64_t High;
};

/// Open files of arrays with the same number of tuples, and the operations that all loaders share.
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
  /// The bytes of one tuple of every array.
  std::size_t recordBytes() const { return this->RecordBytes; }

  /// Returns the range of ids. Throws IOError naming an id that is not a tuple's index.
  IdRange range(const std::int64_t* ids, std::size_t count, int threads) const;

  /// Reads consecutive tuples of array `a`, and counts that as one read. Large reads are split over
  /// threads: if the file is cached, reading is copying.
  void read(std::size_t a, std::int64_t first, std::int64_t tuples, void* to, int threads,
    LoadCounters& counters) const;

private:
  std::vector<RawArray> Arrays;
  std::vector<std::shared_ptr<InputFile>> Files;
  std::int64_t Tuples = 0;
  std::size_t RecordBytes = 0;
};

/// Buffers for a number of tuples of every array.
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
