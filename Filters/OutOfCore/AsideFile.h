// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippAsideFile_h
#define tippAsideFile_h

#include "Files/OutputFile.h"
#include "Messages/Bytes.h"
#include "OutOfCore/Checkpoint.h"
#include "vtkTIPPFiltersModule.h"

#include <cstdint>
#include <memory>
#include <string>

namespace tipp
{

/// A file of what a run keeps but has no memory for, one part behind the other. It belongs to a
/// saved state, which tells the parts and the end.
class VTKTIPPFILTERS_EXPORT AsideFile
{
public:
  /// It is made when there is a part.
  explicit AsideFile(std::string path);

  struct Part
  {
    std::uint64_t Offset = 0;
    std::uint64_t Bytes = 0;
    std::uint64_t Checksum = 0;
  };
  /// Throws IOError.
  Part put(const SaveArchive& archive);
  /// Throws IOError, also where it is not what was put there.
  Bytes get(const Part& part) const;

  std::uint64_t end() const { return this->End; }
  /// Takes over the file of an earlier run, all of it before this end. Throws IOError if it is
  /// shorter.
  void goOnFrom(std::uint64_t end);

private:
  std::string Path;
  std::uint64_t End = 0;
  std::unique_ptr<const OutputFile> File;
};

} // namespace tipp

#endif
