// SPDX-License-Identifier: BSD-3-Clause
#include "Files/OutputFile.h"

#include "Files/IOError.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

namespace tipp
{

void failToWrite(const std::string& path)
{
  const char* const advice =
    errno == ENOSPC || errno == EDQUOT ? "; free space on its disk or name another." : ".";
  throw IOError(path, std::string("cannot be written (") + std::strerror(errno) + ")" + advice);
}

namespace
{

int openToWrite(const std::string& path, int flags)
{
  const int descriptor = open(path.c_str(), O_WRONLY | O_CLOEXEC | flags, 0666);
  if (descriptor < 0)
  {
    failToWrite(path);
  }
  return descriptor;
}

} // namespace

OutputFile::OutputFile(const std::string& path)
  : OutputFile(openToWrite(path, O_CREAT | O_TRUNC), path)
{
}

OutputFile OutputFile::shared(const std::string& path)
{
  return { openToWrite(path, 0), path };
}

OutputFile::~OutputFile()
{
  if (this->Descriptor >= 0)
  {
    ::close(this->Descriptor);
  }
}

void writeFully(int descriptor, const std::string& path, std::uint64_t offset, const void* from,
  std::size_t bytes)
{
  // A system call transfers less than 2 GiB.
  constexpr std::size_t most = std::size_t(1) << 30;
  const char* at = static_cast<const char*>(from);
  while (bytes > 0)
  {
    const ssize_t done = pwrite(descriptor, at, std::min(bytes, most), off_t(offset));
    if (done < 0 && errno == EINTR)
    {
      continue;
    }
    if (done < 0)
    {
      failToWrite(path);
    }
    at += done;
    offset += std::uint64_t(done);
    bytes -= std::size_t(done);
  }
}

void OutputFile::write(std::uint64_t offset, const void* from, std::size_t bytes) const
{
  writeFully(this->Descriptor, this->Path, offset, from, bytes);
}

void OutputFile::close()
{
  if (::close(std::exchange(this->Descriptor, -1)) != 0 && errno != EINTR)
  {
    failToWrite(this->Path);
  }
}

void OutputFile::startWriteback() const
{
  // Only a hint: syncToDisk() waits and reports failures.
  static_cast<void>(sync_file_range(this->Descriptor, 0, 0, SYNC_FILE_RANGE_WRITE));
}

void OutputFile::sync() const
{
  if (fsync(this->Descriptor) != 0)
  {
    failToWrite(this->Path);
  }
}

void syncToDisk(const std::string& path)
{
  const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0)
  {
    failToWrite(path);
  }
  OutputFile(descriptor, path).sync();
}

void writeWholeFile(const std::string& path, const std::string& content)
{
  const OutputFile file(path);
  file.write(0, content.data(), content.size());
  file.sync();
}

OutputStream::OutputStream(const OutputFile& file)
  : std::ostream(nullptr)
  , Content(file)
{
  this->rdbuf(&this->Content);
}

void OutputStream::finish()
{
  this->flush();
  if (!this->Content.failure().empty())
  {
    throw IOError(this->Content.failure());
  }
  if (this->fail())
  {
    throw IOError("The output could not be formatted.");
  }
}

OutputStream::Buffer::Buffer(const OutputFile& file)
  : File(file)
  , Bytes(std::size_t(1) << 16)
{
  this->setp(this->Bytes.data(), this->Bytes.data() + this->Bytes.size());
}

/// Writes nothing after a failure: the file is unusable in any case.
bool OutputStream::Buffer::write(const char* from, std::size_t count)
{
  if (!this->Failure.empty())
  {
    return false;
  }
  try
  {
    this->File.write(this->Start, from, count);
  }
  catch (const IOError& error)
  {
    this->Failure = error.what();
    return false;
  }
  this->Start += count;
  this->End = std::max(this->End, this->Start);
  return true;
}

int OutputStream::Buffer::sync()
{
  const bool isWritten = this->write(this->pbase(), std::size_t(this->pptr() - this->pbase()));
  this->setp(this->Bytes.data(), this->Bytes.data() + this->Bytes.size());
  return isWritten ? 0 : -1;
}

int OutputStream::Buffer::overflow(int character)
{
  if (this->sync() != 0)
  {
    return traits_type::eof();
  }
  if (character != traits_type::eof())
  {
    this->sputc(char(character));
  }
  return traits_type::not_eof(character);
}

std::streamsize OutputStream::Buffer::xsputn(const char* from, std::streamsize count)
{
  if (count > this->epptr() - this->pptr())
  {
    return this->sync() == 0 && this->write(from, std::size_t(count)) ? count : 0;
  }
  std::copy_n(from, count, this->pptr());
  this->pbump(int(count));
  return count;
}

OutputStream::Buffer::pos_type OutputStream::Buffer::seekoff(
  off_type by, std::ios_base::seekdir from, std::ios_base::openmode)
{
  if (this->sync() != 0)
  {
    return off_type(-1);
  }
  const std::uint64_t base = from == std::ios_base::beg ? 0
    : from == std::ios_base::cur                        ? this->Start
                                                        : this->End;
  this->Start = base + std::uint64_t(by);
  return off_type(this->Start);
}

OutputStream::Buffer::pos_type OutputStream::Buffer::seekpos(
  pos_type to, std::ios_base::openmode mode)
{
  return this->seekoff(off_type(to), std::ios_base::beg, mode);
}

} // namespace tipp
