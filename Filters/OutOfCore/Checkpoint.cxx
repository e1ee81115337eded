// SPDX-License-Identifier: BSD-3-Clause
#include "OutOfCore/Checkpoint.h"

#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Files/OutputFile.h"
#include "Partitioned/Checksum.h"

#include <filesystem>

namespace tipp
{

void writeCheckpoint(const std::string& path, const SaveArchive& archive)
{
  const std::string next = path + ".next";
  const ByteWriter& bytes = archive.Writer;
  const std::uint64_t checksum = checksumOf(bytes.data(), bytes.size());
  {
    const OutputFile file(next);
    file.write(0, &checksum, 8);
    file.write(8, bytes.data(), bytes.size());
  }
  std::error_code failure;
  std::filesystem::rename(next, path, failure);
  if (failure)
  {
    throw IOError(path, "cannot be replaced (" + failure.message() + ").");
  }
}

Bytes readCheckpoint(const std::string& path)
{
  const InputFile file(path);
  std::uint64_t checksum = 0;
  file.read(0, &checksum, 8);
  Bytes bytes(file.size() - 8);
  file.read(8, bytes.data(), bytes.size());
  if (checksumOf(bytes.data(), bytes.size()) != checksum)
  {
    throw IOError(path, "is damaged; remove its folder and start again.");
  }
  return bytes;
}

} // namespace tipp
