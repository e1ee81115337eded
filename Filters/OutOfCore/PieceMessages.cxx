// SPDX-License-Identifier: BSD-3-Clause
#include "OutOfCore/PieceMessages.h"

#include "OutOfCore/Checkpoint.h"

#include <type_traits>

namespace tipp
{
namespace
{

template <typename T>
struct Kind
{
};

/// @name What a message has, in its order, for both directions
///@{
template <typename Archive, typename Order>
void exchange(Archive& archive, Order& order, Kind<LoadOrder>)
{
  archive(order.Piece);
  archive(order.Finished);
}

template <typename Archive, typename Task>
void exchange(Archive& archive, Task& task, Kind<PartitionTask>)
{
  archive(task.Partition);
  archive(task.Vertices);
}

template <typename Archive, typename Task>
void exchange(Archive& archive, Task& task, Kind<InteriorTask>)
{
  archive(task.Piece);
  archive(task.Rim);
  archive(task.Seams);
}

template <typename Archive, typename Result>
void exchange(Archive& archive, Result& result, Kind<PartitionResult>)
{
  archive(result.Partition);
  archive(result.Points);
  archive(result.Duplicates);
  archive(result.Vertices);
  if constexpr (std::is_same<Archive, SaveArchive>::value)
  {
    result.Seams.write(archive.Writer);
  }
  else
  {
    result.Seams = SeamGroups::read(archive.Reader);
  }
}

template <typename Archive>
void exchange(Archive& archive, WrittenInterior& written, Kind<WrittenInterior>)
{
  archive(written.Piece);
  written.Growing.exchangeInterior(archive);
}

template <typename Archive, typename Number>
void exchange(Archive& archive, Number& number, Kind<std::int32_t>)
{
  archive(number);
}
///@}

template <typename T>
Bytes packed(T& value)
{
  SaveArchive archive;
  exchange(archive, value, Kind<std::remove_const_t<T>>());
  return archive.Writer.take();
}

template <typename T>
void unpackTo(const Bytes& bytes, T& value)
{
  LoadArchive archive(bytes);
  exchange(archive, value, Kind<T>());
}

} // namespace

Bytes pack(const LoadOrder& order)
{
  return packed(order);
}
Bytes pack(const PartitionTask& task)
{
  return packed(task);
}
Bytes pack(const InteriorTask& task)
{
  return packed(task);
}
Bytes pack(const PartitionResult& result)
{
  return packed(result);
}
Bytes pack(WrittenInterior& written)
{
  return packed(written);
}
Bytes pack(std::int32_t number)
{
  return packed(number);
}

void unpack(const Bytes& bytes, LoadOrder& order)
{
  unpackTo(bytes, order);
}
void unpack(const Bytes& bytes, PartitionTask& task)
{
  unpackTo(bytes, task);
}
void unpack(const Bytes& bytes, InteriorTask& task)
{
  unpackTo(bytes, task);
}
void unpack(const Bytes& bytes, PartitionResult& result)
{
  unpackTo(bytes, result);
}
void unpack(const Bytes& bytes, WrittenInterior& written)
{
  unpackTo(bytes, written);
}
void unpack(const Bytes& bytes, std::int32_t& number)
{
  unpackTo(bytes, number);
}

} // namespace tipp
