// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippLasColumns_h
#define tippLasColumns_h

#include "Las/LasHeader.h"
#include "Points/ReadPoints.h"

#include <cstddef>
#include <string>
#include <vector>

namespace tipp
{

/// A column besides x and y.
struct LasColumn
{
  enum class Kind
  {
    Height,
    Class,
    Short, ///< 16 bits
    Time,
    // As formats 6 to 10 have them:
    WrittenClass,
    Returns, ///< 4 bits each: the number, and how many there are
    Flags,   ///< 8 bits: of the class, the scanner channel, direction and edge
    Angle,   ///< in units of 0.006 degrees
    Bytes,   ///< a whole number of up to 4 bytes
    Zero     ///< the file has no such field
  };
  std::string Name;
  Kind Is;
  std::size_t Offset;
  unsigned Attribute; ///< of compressed points
  std::size_t Size = 1;
};

/// The columns of a file: those for writing if the options have LasFields.
std::vector<LasColumn> columnsOf(const LasHeader& header, const PointOptions& options);

} // namespace tipp

#endif
