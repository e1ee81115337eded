// SPDX-License-Identifier: BSD-3-Clause
#include "Files/OutputFile.h"

#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Files/TextFile.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <utility>
#include <vector>

#include <fcntl.h>
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

namespace
{

fs::path resolved(const std::string& path)
{
  std::error_code failure;
  const fs::path whole = fs::weakly_canonical(fs::absolute(path), failure);
  return whole.has_filename() ? whole : whole.parent_path();
}

/// The path that the output will have once links are resolved, even if the target does not exist.
fs::path finalPath(const std::string& output)
{
  try
  {
    return outputPath(output);
  }
  catch (const IOError&) // reported when the output is opened
  {
    return resolved(output);
  }
}

bool isWithin(const fs::path& path, const fs::path& folder)
{
  return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first ==
    folder.end();
}

/// The files that a parallel VTK XML file (.pvtu ...) refers to: its "Source" attributes.
std::vector<std::string> piecesNamedBy(const std::string& path)
{
  const std::string text = readTextFile(path);
  const std::string label = "Source=\"";
  std::vector<std::string> pieces;
  for (std::size_t at = text.find(label); at != std::string::npos; at = text.find(label, at))
  {
    at += label.size();
    const std::string name = text.substr(at, text.find('"', at) - at);
    pieces.push_back((fs::path(path).parent_path() / name).string());
  }
  return pieces;
}

/// The file itself, or the files of a flat or partitioned mesh.
std::vector<std::string> filesOfInput(const std::string& path)
{
  std::error_code failure;
  std::vector<std::string> files;
  if (!fs::is_directory(path, failure))
  {
    const std::string name = fs::path(path).filename().string();
    const bool isIndex = name == "index.json" || name == "mesh.pvtu";
    if (isIndex)
    {
      files = filesOfInput(fs::absolute(path).parent_path().string());
    }
    files.push_back(path);
    if (!isIndex && extensionOf(path).rfind(".pvt", 0) == 0 && fs::is_regular_file(path, failure))
    {
      const std::vector<std::string> pieces = piecesNamedBy(path);
      files.insert(files.end(), pieces.begin(), pieces.end());
    }
    return files;
  }
  for (const char* const part : { "", "pieces", "point_data", "cell_data" })
  {
    for (const fs::directory_entry& entry : fs::directory_iterator(fs::path(path) / part, failure))
    {
      if (entry.is_regular_file(failure))
      {
        files.push_back(entry.path().string());
      }
    }
  }
  return files;
}

/// Checks an output that exists; one that does not cannot be an input.
void requireNoInput(const std::string& output, const std::string& input)
{
  std::error_code failure;
  const bool isFolder = fs::is_directory(output, failure);
  const fs::path folder = resolved(output);
  for (const std::string& file : filesOfInput(input))
  {
    const bool isHit =
      isFolder ? isWithin(resolved(file), folder) : fs::equivalent(file, output, failure);
    if (isHit)
    {
      throw IOError(output,
        (isFolder ? "holds an input of the run, " + input
                  : std::string("is also an input of the run")) +
          ", so it cannot be the output; name another.");
    }
  }
}

} // namespace

void requireApart(const std::vector<std::string>& outputs, const std::vector<std::string>& inputs)
{
  std::error_code failure;
  for (std::size_t i = 0; i < outputs.size(); ++i)
  {
    const std::string& output = outputs[i];
    if (output.empty())
    {
      continue;
    }
    for (std::size_t j = 0; j < i; ++j)
    {
      const bool isSame = !outputs[j].empty() &&
        (isWithin(finalPath(output), finalPath(outputs[j])) ||
          isWithin(finalPath(outputs[j]), finalPath(output)) ||
          fs::equivalent(output, outputs[j], failure));
      if (isSame)
      {
        throw IOError(
          output, "is the same as the output " + outputs[j] + " or lies in it; name another.");
      }
    }
    if (!fs::exists(output, failure))
    {
      continue;
    }
    for (const std::string& input : inputs)
    {
      if (!input.empty())
      {
        requireNoInput(output, input);
      }
    }
  }
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
