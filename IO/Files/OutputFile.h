// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippOutputFile_h
#define tippOutputFile_h

#include "vtkTIPPIOModule.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <ostream>
#include <string>
#include <system_error>
#include <vector>

namespace tipp
{

/// A new file open for writing at any offset. Threads may write concurrently.
class VTKTIPPIO_EXPORT OutputFile
{
public:
  /// Creates the file; throws IOError if that fails.
  explicit OutputFile(const std::string& path);
  /// Takes ownership of an open descriptor; errors call the file `name`.
  OutputFile(int descriptor, const std::string& name)
    : Path(name)
    , Descriptor(descriptor)
  {
  }
  /// Opens an existing file, which other processes may write at the same time.
  static OutputFile shared(const std::string& path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  const std::string& path() const { return this->Path; }
  int descriptor() const { return this->Descriptor; }
  /// Writes `bytes` bytes at `offset`, in bytes. Throws IOError, for example if the disk is full.
  void write(std::uint64_t offset, const void* from, std::size_t bytes) const;
  /// Closes the file. Throws IOError also for delayed write errors. Other machines that open the
  /// file afterwards see all of it.
  void close();
  /// Starts writing cached data to the disk, without waiting.
  void startWriteback() const;
  /// Returns once all data are on the disk; throws IOError.
  void sync() const;

private:
  std::string Path;
  int Descriptor;
};

/// Writes all bytes at an offset of an open file; errors call it `path`. Throws IOError.
VTKTIPPIO_EXPORT void writeFully(int descriptor, const std::string& path, std::uint64_t offset,
  const void* from, std::size_t bytes);

/// Throws IOError with the reason in errno.
[[noreturn]] VTKTIPPIO_EXPORT void failToWrite(const std::string& path);

/// Locks a file or folder until the descriptor is closed; returns -1 if it cannot be opened or,
/// with errno EWOULDBLOCK, if another process has locked it.
int lockPath(const std::string& path, int flags);

/// Returns once a file or folder is on its disk; throws IOError.
VTKTIPPIO_EXPORT void syncToDisk(const std::string& path);

/// Writes a whole file and returns once it is on the disk; throws IOError.
VTKTIPPIO_EXPORT void writeWholeFile(const std::string& path, const std::string& content);

/// A seekable stream into an OutputFile. Writers need not check its state: finish() reports the
/// first write that failed, even if the state was cleared since.
class VTKTIPPIO_EXPORT OutputStream : public std::ostream
{
public:
  explicit OutputStream(const OutputFile& file);
  ~OutputStream() override;

  /// Writes what is buffered. Throws IOError if this or any earlier write failed.
  void finish();

private:
  class Buffer;
  std::unique_ptr<Buffer> Content;
};

/// Whether there is a file or folder at the path; false if that cannot be found out.
inline bool pathExists(const std::string& path)
{
  std::error_code ignored;
  return std::filesystem::exists(path, ignored);
}

/// Removes a file if it is there. Errors are ignored.
inline void removeFile(const std::string& path)
{
  std::error_code ignored;
  std::filesystem::remove(path, ignored);
}

/// Returns the path that an output must be moved to: absolute, without a slash at the end, and with
/// links resolved, because a rename would replace the link. Throws IOError if the parent folder is
/// missing or not writable, or if the name is too long.
std::filesystem::path outputPath(const std::string& path);

/// Throws IOError, about the output `path`, if the disk of a folder has less free space than the
/// `needed` bytes.
VTKTIPPIO_EXPORT void requireFreeSpace(
  const std::string& path, const std::string& folder, std::uint64_t needed);

} // namespace tipp

#endif
