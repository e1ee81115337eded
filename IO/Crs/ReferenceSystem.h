// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippReferenceSystem_h
#define tippReferenceSystem_h

#include "Crs/CrsRecords.h"
#include "vtkTIPPIOModule.h"

#include <string>

namespace tipp
{

/// A coordinate reference system, as far as it is understood.
struct ReferenceSystem
{
  /// "EPSG:code", "EPSG:code+code" (the second is that of the heights) or WKT; empty if there is
  /// none, or if nothing of it is understood.
  std::string Text;
  std::string Words;   ///< its name, code and units, for people; empty without GDAL
  std::string Problem; ///< what is not understood: the end of a sentence about the file; or empty
};

/// Understands the records of a file, with GDAL if that is there; without it, EPSG codes and WKT
/// are passed on as they are. GDAL runs in a child process: see geoKeysOf(). Does not throw because
/// of the records' content.
VTKTIPPIO_EXPORT ReferenceSystem understandCrs(const CrsRecords& records);

/// Describes the system that a text names, one that a user gave or that of a ReferenceSystem.
/// Returns it as it is, and without words if it is not understood.
VTKTIPPIO_EXPORT ReferenceSystem describeCrs(const std::string& text);

/// Returns the WKT 1 (of 2001, as LAS has it) of a ReferenceSystem's text, or of one that the user
/// gave; empty if it cannot be expressed so, and without GDAL. In the Python wheel, throws IOError
/// with what to install if it is the user's and nothing that translates it is there.
VTKTIPPIO_EXPORT std::string wkt1Of(const std::string& text, bool isOfUser = false);

/// Returns whether the texts of two ReferenceSystems mean the same system, however it is written.
/// If only one has a system of heights, only the horizontal systems are compared.
VTKTIPPIO_EXPORT bool areSameCrs(const std::string& a, const std::string& b);

} // namespace tipp

#endif
