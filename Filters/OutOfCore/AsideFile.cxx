// SPDX-License-Identifier: BSD-3-Clause
#include "OutOfCore/AsideFile.h"

#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Partitioned/Checksum.h"

#include <utility>

namespace tipp
{

AsideFile::AsideFile(std::string path)
  : Path(std::move(path))
{
}

AsideFile::Part AsideFile::put(const SaveArchive& archive)
{
  if (!this->File)
  {
    this->File.reset(
      this->End == 0 ? new OutputFile(this->Path) : new OutputFile(OutputFile::shared(this->Path)));
  }
  const ByteWriter& bytes = archive.Writer;
  const Part part{ this->End, bytes.size(), checksumOf(bytes.data(), bytes.size()) };
  this->File->write(part.Offset, bytes.data(), bytes.size());
  this->End += part.Bytes;
  return part;
}

Bytes AsideFile::get(const Part& part) const
{
  const InputFile file(this->Path);
  if (part.Offset <= file.size() && part.Bytes <= file.size() - part.Offset)
  {
    Bytes bytes(part.Bytes);
    file.read(part.Offset, bytes.data(), bytes.size());
    if (checksumOf(bytes.data(), bytes.size()) == part.Checksum)
    {
      return bytes;
    }
  }
  throw IOError(this->Path, "is damaged; resume the run, which makes it again.");
}

void AsideFile::goOnFrom(std::uint64_t end)
{
  if (end > 0 && InputFile(this->Path).size() < end)
  {
    throw IOError(this->Path, "is shorter than it was; resume the run, which makes it again.");
  }
  this->End = end;
}

} // namespace tipp
