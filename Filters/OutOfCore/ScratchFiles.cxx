// SPDX-License-Identifier: BSD-3-Clause
#include "OutOfCore/ScratchFiles.h"

#include "Files/Checksum.h"
#include "Files/IOError.h"
#include "Files/InputFile.h"

#include <algorithm>
#include <filesystem>
#include <sys/stat.h>

namespace tipp
{
namespace
{

namespace fs = std::filesystem;

constexpr const char* nextSuffix = ".next"; // appended to the path until a file is complete

void takeName(const std::string& path)
{
  std::error_code failure;
  fs::rename(path + nextSuffix, path, failure);
  if (failure)
  {
    throw IOError(path, "cannot be replaced (" + failure.message() + ").");
  }
}

/// The beginning of a file of sections.
struct Header
{
  std::uint64_t TableOffset;
  std::uint64_t Entries;
  std::uint64_t TableChecksum;
};

bool isBefore(const SectionEntry& a, const SectionEntry& b)
{
  return a.Key < b.Key;
}

[[noreturn]] void refuse(const std::string& path)
{
  throw IOError(path, "is damaged.");
}

void makeFolder(const std::string& path)
{
  std::error_code failure;
  fs::create_directory(path, failure);
  if (failure)
  {
    throw IOError(path, "cannot be made (" + failure.message() + "); name another folder.");
  }
}

bool areOnOneDisk(const std::string& a, const std::string& b)
{
  struct stat ofA = {};
  struct stat ofB = {};
  return stat(a.c_str(), &ofA) == 0 && stat(b.c_str(), &ofB) == 0 && ofA.st_dev == ofB.st_dev;
}

} // namespace

void writeCheckedFile(const std::string& path, const std::function<void(SaveArchive&)>& save)
{
  {
    std::uint64_t end = 8;
    const OutputFile file(path + nextSuffix);
    Checksum sum;
    SaveArchive archive;
    archive.setSink(
      [&](const char* data, std::size_t size)
      {
        sum.add(data, size);
        file.write(end, data, size);
        end += size;
      });
    save(archive);
    archive.flush();
    const std::uint64_t checksum = sum.finish();
    file.write(0, &checksum, 8);
  }
  takeName(path);
}

Bytes readCheckedFile(const std::string& path)
{
  if (!pathExists(path))
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

SectionFileWriter::SectionFileWriter(const std::string& path)
  : Path(path)
  , File(path + nextSuffix)
  , End(sizeof(Header))
{
}

void SectionFileWriter::add(SectionKey key, const Bytes& content)
{
  this->Table.push_back(
    { key, this->End, content.size(), checksumOf(content.data(), content.size()) });
  this->File.write(this->End, content.data(), content.size());
  this->End += content.size();
}

void SectionFileWriter::finish()
{
  std::sort(this->Table.begin(), this->Table.end(), isBefore);
  const std::size_t bytes = this->Table.size() * sizeof(SectionEntry);
  const Header header{ this->End, this->Table.size(), checksumOf(this->Table.data(), bytes) };
  this->File.write(this->End, this->Table.data(), bytes);
  this->File.write(0, &header, sizeof(header));
  this->File.close();
  takeName(this->Path);
}

SectionFile::SectionFile(const std::string& path)
  : Path(path)
{
  const InputFile file(path);
  Header header{};
  file.read(0, &header, sizeof(header));
  const std::uint64_t bytes = header.Entries * sizeof(SectionEntry);
  if (header.TableOffset > file.size() || header.Entries > file.size() ||
    bytes != file.size() - header.TableOffset)
  {
    refuse(path);
  }
  this->Table.resize(header.Entries);
  file.read(header.TableOffset, this->Table.data(), bytes);
  if (checksumOf(this->Table.data(), bytes) != header.TableChecksum)
  {
    refuse(path);
  }
}

const SectionEntry* SectionFile::find(SectionKey key) const
{
  const auto found = std::lower_bound(
    this->Table.begin(), this->Table.end(), SectionEntry{ key, 0, 0, 0 }, isBefore);
  return found == this->Table.end() || key < found->Key ? nullptr : &*found;
}

Bytes SectionFile::read(SectionKey key) const
{
  const SectionEntry* const entry = this->find(key);
  if (!entry)
  {
    refuse(this->Path);
  }
  Bytes bytes(entry->Size);
  InputFile(this->Path).read(entry->Offset, bytes.data(), bytes.size());
  if (checksumOf(bytes.data(), bytes.size()) != entry->Checksum)
  {
    refuse(this->Path);
  }
  return bytes;
}

void SectionFile::verify() const
{
  for (const SectionEntry& entry : this->Table)
  {
    this->read(entry.Key);
  }
}

ScratchFolder::ScratchFolder(PendingFolder& mesh, const std::string& other)
  : Mesh(mesh)
{
  if (!other.empty())
  {
    const std::string name = fs::path(mesh.workPath()).filename().string();
    this->Other.reset(new WorkFolder(WorkFolder::at(
      other + "/" + name, "Temporary files of the run that makes " + mesh.temporaryPath() + "\n")));
  }
  this->keep(this->isKept());
}

ScratchFolder::~ScratchFolder()
{
  if (!this->isKept())
  {
    this->removeFiles(this->results());
    this->removeFiles(this->points());
  }
}

void ScratchFolder::keep(bool kept)
{
  this->Mesh.work().keep(kept);
  if (this->Other)
  {
    this->Other->keep(kept);
  }
}

bool ScratchFolder::hasRun() const
{
  return pathExists(this->plan()) || !this->files(this->results()).empty();
}

void ScratchFolder::clear()
{
  // Results without a plan would look like those of a run that lost its plan.
  this->removeFiles(this->results());
  this->Mesh.work().clear();
  makeFolder(this->Mesh.temporaryPath());
  makeFolder(this->Mesh.temporaryPath() + "/pieces");
}

void ScratchFolder::requireSpace(
  const std::string& path, std::uint64_t mesh, std::uint64_t scratch) const
{
  if (areOnOneDisk(this->Mesh.workPath(), this->folder()))
  {
    requireFreeSpace(path, this->folder(), mesh + scratch);
    return;
  }
  requireFreeSpace(path, this->Mesh.workPath(), mesh);
  requireFreeSpace(path, this->folder(), scratch);
}

bool canResume(const std::string& path)
{
  try
  {
    return pathExists(WorkFolder::lastingPath(path) + ScratchFolder::planName);
  }
  catch (const IOError&) // a run reports this error
  {
    return false;
  }
}

/// Returns the files in folder() whose paths begin with `begin` and a dot.
std::vector<std::string> ScratchFolder::files(const std::string& begin) const
{
  const std::string prefix = fs::path(begin).filename().string() + ".";
  std::vector<std::string> paths;
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(this->folder(), ignored))
  {
    if (entry.path().filename().string().compare(0, prefix.size(), prefix) == 0)
    {
      paths.push_back(entry.path().string());
    }
  }
  return paths;
}

void ScratchFolder::removeFiles(const std::string& begin) const
{
  for (const std::string& path : this->files(begin))
  {
    removeFile(path);
  }
}

} // namespace tipp
