// SPDX-License-Identifier: BSD-3-Clause
#include "OutOfCore/Checkpoint.h"

#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Files/OutputFile.h"
#include "Partitioned/Checksum.h"

#include <filesystem>

namespace tipp
{

std::uint64_t writeCheckpoint(
  const std::string& path, const std::function<void(SaveArchive&)>& save)
{
  const std::string next = path + ".next";
  std::uint64_t end = 8;
  {
    const OutputFile file(next);
    Checksum sum;
    SaveArchive archive;
    archive.Writer.setSink(
      [&](const char* data, std::size_t size)
      {
        sum.add(data, size);
        file.write(end, data, size);
        end += size;
      });
    save(archive);
    archive.Writer.flush();
    const std::uint64_t checksum = sum.finish();
    file.write(0, &checksum, 8);
  }
  std::error_code failure;
  std::filesystem::rename(next, path, failure);
  if (failure)
  {
    throw IOError(path, "cannot be replaced (" + failure.message() + ").");
  }
  return end;
}

Bytes readCheckpoint(const std::string& path)
{
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored))
  {
    throw IOError(path, "is missing; remove its folder and start again.");
  }
  const InputFile file(path);
  if (file.size() >= 8)
  {
    std::uint64_t checksum = 0;
    file.read(0, &checksum, 8);
    Bytes bytes(file.size() - 8);
    file.read(8, bytes.data(), bytes.size());
    if (checksumOf(bytes.data(), bytes.size()) == checksum)
    {
      return bytes;
    }
  }
  throw IOError(path, "is damaged; remove its folder and start again.");
}

} // namespace tipp
