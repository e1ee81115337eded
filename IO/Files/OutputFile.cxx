// SPDX-License-Identifier: BSD-3-Clause
#include "Files/OutputFile.h"

#include "Files/IOError.h"
#include "Files/MemoryLimits.h"
#include "Files/Platform.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace tipp
{
namespace fs = std::filesystem;

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
  tipp::startWriteback(this->Descriptor);
}

void OutputFile::sync() const
{
  if (fsync(this->Descriptor) != 0)
  {
    failToWrite(this->Path);
  }
}

int lockPath(const std::string& path, int flags)
{
  const int lock = open(path.c_str(), O_RDONLY | O_CLOEXEC | flags);
  if (lock >= 0 && flock(lock, LOCK_EX | LOCK_NB) != 0)
  {
    close(lock);
    errno = EWOULDBLOCK;
    return -1;
  }
  return lock;
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

class OutputStream::Buffer : public std::streambuf
{
public:
  explicit Buffer(const OutputFile& file)
    : File(file)
    , Bytes(std::size_t(1) << 16)
  {
    this->setp(this->Bytes.data(), this->Bytes.data() + this->Bytes.size());
  }

  const std::string& failure() const { return this->Failure; }

protected:
  int overflow(int character) override
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

  std::streamsize xsputn(const char* from, std::streamsize count) override
  {
    if (count > this->epptr() - this->pptr())
    {
      return this->sync() == 0 && this->write(from, std::size_t(count)) ? count : 0;
    }
    std::copy_n(from, count, this->pptr());
    this->pbump(int(count));
    return count;
  }

  int sync() override
  {
    keepMemoryLimits(); // what is written may lie there
    const bool isWritten = this->write(this->pbase(), std::size_t(this->pptr() - this->pbase()));
    this->setp(this->Bytes.data(), this->Bytes.data() + this->Bytes.size());
    return isWritten ? 0 : -1;
  }

  pos_type seekoff(off_type by, std::ios_base::seekdir from, std::ios_base::openmode) override
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

  pos_type seekpos(pos_type to, std::ios_base::openmode mode) override
  {
    return this->seekoff(off_type(to), std::ios_base::beg, mode);
  }

private:
  /// Writes nothing after a failure: the file is unusable in any case.
  bool write(const char* from, std::size_t count)
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

  const OutputFile& File;
  std::vector<char> Bytes;
  std::uint64_t Start = 0; ///< offset in the file of the buffer's first byte
  std::uint64_t End = 0;   ///< size of the file so far, without the buffer
  std::string Failure;
};

OutputStream::OutputStream(const OutputFile& file)
  : std::ostream(nullptr)
  , Content(std::make_unique<Buffer>(file))
{
  this->rdbuf(this->Content.get());
}

OutputStream::~OutputStream() = default;

void OutputStream::finish()
{
  this->flush();
  if (!this->Content->failure().empty())
  {
    throw IOError(this->Content->failure());
  }
  if (this->fail())
  {
    throw IOError("The output could not be formatted.");
  }
}

namespace
{

/// Follows links to the end, even if their target does not exist.
fs::path linkTarget(const std::string& path, fs::path target)
{
  std::error_code failure;
  constexpr int mostLinks = 40; // Linux's own limit
  for (int i = 0; fs::is_symlink(target, failure); ++i)
  {
    if (i == mostLinks)
    {
      throw IOError(path, "is a link that leads to itself; name another file.");
    }
    target = (target.parent_path() / fs::read_symlink(target, failure)).lexically_normal();
  }
  return target;
}

} // namespace

fs::path outputPath(const std::string& path)
{
  std::error_code failure;
  fs::path target = path.empty() ? fs::path() : fs::absolute(path);
  if (!target.has_filename())
  {
    target = target.parent_path(); // the path ended with a slash
  }
  target = linkTarget(path, target);
  // Resolve links among the folders first: "link/.." is not the link's own folder.
  const fs::path folder = fs::weakly_canonical(target.parent_path(), failure);
  target = folder / target.filename();
  if (!target.has_filename() || target.filename() == ".." || !fs::is_directory(folder, failure))
  {
    throw IOError(path, "its folder does not exist; create it or name another.");
  }
  if (target.filename() == ".")
  {
    target = folder;
  }
  if (access(folder.c_str(), W_OK) != 0)
  {
    throw IOError(path, "its folder cannot be written to; change its permissions or name another.");
  }
  struct stat ignored = {};
  if (lstat(target.c_str(), &ignored) != 0 && errno != ENOENT)
  {
    throw IOError(
      path, std::string("cannot be written (") + std::strerror(errno) + "); name another.");
  }
  return target;
}

void requireFreeSpace(const std::string& path, const std::string& folder, std::uint64_t needed)
{
  std::error_code failure;
  const fs::space_info space = fs::space(folder, failure);
  if (!failure && space.available < needed)
  {
    throw IOError(path,
      "needs about " + std::to_string(needed / 1000000 + 1) +
        " MB while it is made, and the disk of " + folder + " has " +
        std::to_string(space.available / 1000000) + " MB free; free space or name another disk.");
  }
}

} // namespace tipp
