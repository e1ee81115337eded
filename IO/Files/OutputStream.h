// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippOutputStream_h
#define tippOutputStream_h

#include "Files/OutputFile.h"

#include "vtkTIPPIOModule.h"

#include <cstdint>
#include <ostream>
#include <string>
#include <vector>

namespace tipp
{

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
