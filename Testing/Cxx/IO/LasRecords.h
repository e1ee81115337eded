// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippLasRecords_h
#define tippLasRecords_h

#include "Files/InputFile.h"
#include "Las/LasHeader.h"
#include "Las/LazFile.h"
#include "Points/ReadPoints.h"

#include <string>

namespace tipp::test
{

/// All points, whatever their flags.
inline LasSelection keepAll()
{
  LasSelection all;
  all.KeepWithheld = all.KeepSynthetic = all.KeepOverlap = true;
  return all;
}

/// The bytes of all point records of a LAS or LAZ file.
inline std::string recordsOf(const std::string& path)
{
  const LasHeader header = readLasHeader(path);
  const InputFile file(path);
  std::string records(std::size_t(header.Points) * header.RecordLength, '\0');
  if (!header.Compressed)
  {
    file.read(header.PointOffset, records.data(), records.size());
    return records;
  }
  const LazFile laz(path, header);
  LazReader reader(laz, laz::All);
  std::size_t at = 0;
  for (std::size_t i = 0; i < laz.chunks().size(); ++i)
  {
    const auto points = std::size_t(laz.chunks()[i].Points);
    reader.begin(file, i);
    reader.read(points, &records[at]);
    at += points * header.RecordLength;
  }
  return records;
}

} // namespace tipp::test

#endif
