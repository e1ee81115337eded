// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippVertexFile_h
#define tippVertexFile_h

#include "Distributed/SeamGroups.h"
#include "Files/InputFile.h"
#include "Files/OutputFile.h"
#include "vtkTIPPFiltersModule.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace tipp
{

/// A scratch file of vertices that there is no memory for. What is freed gives its room to others.
/// The file lives as long as the object. Not thread-safe.
class VTKTIPPFILTERS_EXPORT VertexFile
{
public:
  /// It is made when there are vertices; another one of that name is replaced.
  explicit VertexFile(std::string path);
  ~VertexFile();
  VertexFile(const VertexFile&) = delete;
  VertexFile& operator=(const VertexFile&) = delete;

  struct Part
  {
    std::uint64_t Offset = 0; ///< in bytes
    std::uint64_t Count = 0;  ///< of vertices
    std::uint64_t Checksum = 0;
  };
  /// Throws IOError.
  Part put(const PlainVertex* vertices, std::size_t count);
  /// Adds what was put there. Throws IOError if it is not that.
  void get(const Part& part, std::vector<PlainVertex>& vertices) const;
  void free(const Part& part);

  /// Bytes that are there now, and that the file has room for.
  std::uint64_t used() const { return this->Used; }
  std::uint64_t size() const { return this->End; }
  /// Bytes written to it in all.
  std::uint64_t written() const { return this->Written; }

private:
  std::uint64_t allocate(std::uint64_t bytes);

  const std::string Path;
  std::unique_ptr<const OutputFile> File;
  std::unique_ptr<const InputFile> Source;     ///< the same
  std::map<std::uint64_t, std::uint64_t> Free; ///< bytes from each offset on; none touch
  std::uint64_t End = 0;
  std::uint64_t Used = 0;
  std::uint64_t Written = 0;
};

} // namespace tipp

#endif
