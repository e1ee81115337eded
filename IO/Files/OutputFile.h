// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippOutputFile_h
#define tippOutputFile_h

#include "vtkTIPPIOModule.h"

#include <cstddef>
#include <cstdint>
#include <string>

namespace tipp
{

/// A new file open for writes at any place, from any number of threads at once.
class VTKTIPPIO_EXPORT OutputFile
{
public:
  /// Throws IOError if it cannot be made.
  explicit OutputFile(const std::string& path);
  /// Takes an open file; `name` stands for it in errors.
  OutputFile(int descriptor, const std::string& name)
    : Path(name)
    , Descriptor(descriptor)
  {
  }
  /// Opens one that is there already, which other processes may write to as well.
  static OutputFile shared(const std::string& path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  const std::string& path() const { return this->Path; }
  /// Throws IOError, as for a full disk.
  void write(std::uint64_t offset, const void* from, std::size_t bytes) const;
  /// No more writes. Throws IOError also for what the system could not write until now; other
  /// machines that open the file afterwards see all of it.
  void close();
  /// Has the system begin to write what it holds back.
  void startWriteback() const;
  /// Returns when all that was written is safe on the disk; throws IOError.
  void sync() const;

private:
  std::string Path;
  int Descriptor;
};

/// Throws IOError with the reason that errno gives.
[[noreturn]] VTKTIPPIO_EXPORT void failToWrite(const std::string& path);

/// Returns when a file or folder is safe on its disk; throws IOError.
VTKTIPPIO_EXPORT void syncToDisk(const std::string& path);

/// Writes a whole file and returns when it is safe; throws IOError.
VTKTIPPIO_EXPORT void writeWholeFile(const std::string& path, const std::string& content);

} // namespace tipp

#endif
