// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippOutputFile_h
#define tippOutputFile_h

#include "vtkTIPPIOModule.h"

#include <cstddef>
#include <cstdint>
#include <ostream>
#include <string>
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

  /// Writes what is buffered. Throws IOError if this or any earlier write failed.
  void finish();

private:
  class Buffer : public std::streambuf
  {
  public:
    explicit Buffer(const OutputFile& file);
    const std::string& failure() const { return this->Failure; }

  protected:
    int overflow(int character) override;
    std::streamsize xsputn(const char* from, std::streamsize count) override;
    int sync() override;
    pos_type seekoff(off_type by, std::ios_base::seekdir from, std::ios_base::openmode) override;
    pos_type seekpos(pos_type to, std::ios_base::openmode) override;

  private:
    bool write(const char* from, std::size_t count);

    const OutputFile& File;
    std::vector<char> Bytes;
    std::uint64_t Start = 0; ///< offset in the file of the buffer's first byte
    std::uint64_t End = 0;   ///< size of the file so far, without the buffer
    std::string Failure;
  };

  Buffer Content;
};

} // namespace tipp

#endif
