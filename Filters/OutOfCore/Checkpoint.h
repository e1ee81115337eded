// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCheckpoint_h
#define tippCheckpoint_h

#include "Messages/Bytes.h"
#include "Partitioned/PublishPieces.h"
#include "vtkTIPPFiltersModule.h"

#include <cstdint>
#include <functional>
#include <string>
#include <type_traits>
#include <vector>

namespace tipp
{

/// Takes numbers and vectors of them, and things made of these, to save them.
class SaveArchive
{
public:
  template <typename T>
  void operator()(const T& value)
  {
    this->Writer.value(value);
  }
  template <typename T>
  void operator()(const std::vector<T>& values)
  {
    if constexpr (std::is_trivially_copyable<T>::value)
    {
      this->Writer.array(values);
    }
    else
    {
      this->Writer.value(std::uint64_t(values.size()));
      for (const T& value : values)
      {
        (*this)(value);
      }
    }
  }
  void operator()(const std::string& text) { this->Writer.text(text); }

  ByteWriter Writer;
};

/// Gives back what a SaveArchive took, in the same order; throws std::runtime_error where it ends
/// early.
class LoadArchive
{
public:
  explicit LoadArchive(const Bytes& bytes)
    : Reader(bytes)
  {
  }

  template <typename T>
  void operator()(T& value)
  {
    value = this->Reader.template value<T>();
  }
  template <typename T>
  void operator()(std::vector<T>& values)
  {
    if constexpr (std::is_trivially_copyable<T>::value)
    {
      this->Reader.array(values);
    }
    else
    {
      const auto count = this->Reader.template value<std::uint64_t>();
      values.clear();
      for (std::uint64_t i = 0; i < count; ++i)
      {
        values.emplace_back();
        (*this)(values.back());
      }
    }
  }
  void operator()(std::string& text) { text = this->Reader.text(); }

  ByteReader Reader;
};

template <typename Archive, typename Group>
void exchangeGroups(Archive& archive, std::vector<Group>& groups)
{
  std::uint64_t count = groups.size();
  archive(count);
  groups.resize(count);
  for (Group& group : groups)
  {
    archive(group.To);
    archive(group.Count);
  }
}

/// What is known of a finished piece before it is published.
template <typename Archive>
void exchange(Archive& archive, FinishedPiece& piece)
{
  archive(piece.Summary);
  archive(piece.Table.Offsets);
  exchangeGroups(archive, piece.Table.PointGroups);
  exchangeGroups(archive, piece.Table.CellGroups);
  archive(piece.Table.Checksums);
  archive(piece.Table.HeaderBytes);
  archive(piece.Table.HeaderChecksum);
  archive(piece.TriangleSum);
}

/// Puts what save() shows to an archive into a file with a checksum, and this in the path's place
/// in one step; holds little of it in memory. Returns its bytes. Throws IOError.
VTKTIPPFILTERS_EXPORT std::uint64_t writeCheckpoint(
  const std::string& path, const std::function<void(SaveArchive&)>& save);

/// Throws IOError for a file that is not what writeCheckpoint() wrote.
VTKTIPPFILTERS_EXPORT Bytes readCheckpoint(const std::string& path);

} // namespace tipp

#endif
