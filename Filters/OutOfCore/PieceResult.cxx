// SPDX-License-Identifier: BSD-3-Clause
#include "OutOfCore/PieceResult.h"

#include "OutOfCore/Checkpoint.h"

namespace tipp
{
namespace
{

enum SectionKind : std::uint32_t
{
  InteriorSection,
  FiguresSection,
  HullSection,
  BorderSection,
  MessageSection
};

template <typename Archive>
void exchange(Archive& archive, BorderTriangles& border)
{
  archive(border.Corners);
  archive(border.Borrowers);
  archive(border.BorrowerEnds);
}

} // namespace

std::uint64_t writeResult(const std::string& path, PieceResult& result)
{
  SectionFileWriter file(path);
  {
    SaveArchive interior;
    result.Interior.exchangeInterior(interior);
    file.add({ InteriorSection, 0 }, interior.Writer);
  }
  ByteWriter figures;
  figures.value(result.Figures);
  file.add({ FiguresSection, 0 }, figures);
  ByteWriter hull;
  write(hull, result.HullVertices);
  file.add({ HullSection, 0 }, hull);
  for (auto& [owner, triangles] : result.Borders)
  {
    SaveArchive border;
    exchange(border, triangles);
    file.add({ BorderSection, owner }, border.Writer);
  }
  for (const auto& [to, messages] : result.Sent)
  {
    ByteWriter writer;
    for (const auto& [partition, message] : messages)
    {
      writer.value(partition);
      write(writer, message);
    }
    file.add({ MessageSection, to }, writer);
  }
  return file.finish();
}

bool StoredResult::hasMessages(PartitionIndex to) const
{
  return this->File.has({ MessageSection, to });
}

SentMessages StoredResult::readMessages(PartitionIndex to) const
{
  const Bytes bytes = this->File.read({ MessageSection, to });
  SentMessages messages;
  for (ByteReader reader(bytes); reader.left() > 0;)
  {
    messages.emplace_back(reader.value<PartitionIndex>(), VertexMessage{});
    read(reader, messages.back().second);
  }
  return messages;
}

bool StoredResult::hasBorder(PartitionIndex owner) const
{
  return this->File.has({ BorderSection, owner });
}

BorderTriangles StoredResult::readBorder(PartitionIndex owner) const
{
  const Bytes bytes = this->File.read({ BorderSection, owner });
  LoadArchive archive(bytes);
  BorderTriangles border;
  exchange(archive, border);
  return border;
}

std::vector<BoundaryVertex> StoredResult::readHullVertices() const
{
  const Bytes bytes = this->File.read({ HullSection, 0 });
  ByteReader reader(bytes);
  std::vector<BoundaryVertex> vertices;
  read(reader, vertices);
  return vertices;
}

PieceFigures StoredResult::readFigures() const
{
  const Bytes bytes = this->File.read({ FiguresSection, 0 });
  return ByteReader(bytes).value<PieceFigures>();
}

void StoredResult::readInterior(GrowingPiece& interior) const
{
  const Bytes bytes = this->File.read({ InteriorSection, 0 });
  LoadArchive archive(bytes);
  interior.exchangeInterior(archive);
}

} // namespace tipp
