// SPDX-License-Identifier: BSD-3-Clause
#include "OutOfCore/PieceMessages.h"

#include "OutOfCore/Checkpoint.h"

namespace tipp
{
namespace
{

template <typename Archive, typename Order>
void exchangeOrder(Archive& archive, Order& order)
{
  archive(order.Piece);
  archive(order.Finished);
}

template <typename Archive, typename Task>
void exchangeTask(Archive& archive, Task& task)
{
  archive(task.Partition);
  archive(task.Vertices);
}

template <typename Archive, typename Task>
void exchangeInteriorTask(Archive& archive, Task& task)
{
  archive(task.Piece);
  archive(task.Rim);
  archive(task.Seams);
}

template <typename Archive, typename Result>
void exchangeResult(Archive& archive, Result& result)
{
  archive(result.Partition);
  archive(result.Points);
  archive(result.Duplicates);
  archive(result.Vertices);
}

} // namespace

Bytes pack(const LoadOrder& order)
{
  SaveArchive archive;
  exchangeOrder(archive, order);
  return archive.Writer.take();
}

Bytes pack(const PartitionTask& task)
{
  SaveArchive archive;
  exchangeTask(archive, task);
  return archive.Writer.take();
}

Bytes pack(const InteriorTask& task)
{
  SaveArchive archive;
  exchangeInteriorTask(archive, task);
  return archive.Writer.take();
}

Bytes pack(const PartitionResult& result)
{
  SaveArchive archive;
  exchangeResult(archive, result);
  result.Seams.write(archive.Writer);
  return archive.Writer.take();
}

Bytes pack(WrittenInterior& written)
{
  SaveArchive archive;
  archive(written.Piece);
  written.Growing.exchangeInterior(archive);
  return archive.Writer.take();
}

Bytes pack(std::int32_t number)
{
  SaveArchive archive;
  archive(number);
  return archive.Writer.take();
}

void unpack(const Bytes& bytes, LoadOrder& order)
{
  LoadArchive archive(bytes);
  exchangeOrder(archive, order);
}

void unpack(const Bytes& bytes, PartitionTask& task)
{
  LoadArchive archive(bytes);
  exchangeTask(archive, task);
}

void unpack(const Bytes& bytes, InteriorTask& task)
{
  LoadArchive archive(bytes);
  exchangeInteriorTask(archive, task);
}

void unpack(const Bytes& bytes, PartitionResult& result)
{
  LoadArchive archive(bytes);
  exchangeResult(archive, result);
  result.Seams = SeamGroups::read(archive.Reader);
}

void unpack(const Bytes& bytes, WrittenInterior& written)
{
  LoadArchive archive(bytes);
  archive(written.Piece);
  written.Growing.exchangeInterior(archive);
}

void unpack(const Bytes& bytes, std::int32_t& number)
{
  LoadArchive archive(bytes);
  archive(number);
}

} // namespace tipp
