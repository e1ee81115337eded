// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCrsRecords_h
#define tippCrsRecords_h

#include <string>
#include <tuple>

namespace tipp
{

/// What a file says about its coordinate reference system, as it says it. This is data of unknown
/// origin: it may describe a system, but it never names a file or an address to read.
struct CrsRecords
{
  std::string Text;    ///< WKT or PROJJSON; empty: there is none
  std::string Keys;    ///< GeoTIFF's key directory, little-endian (tag 34735)
  std::string Doubles; ///< the numbers that the keys refer to (tag 34736)
  std::string Ascii;   ///< the texts that the keys refer to (tag 34737)

  bool isEmpty() const { return this->Text.empty() && this->Keys.empty(); }
  bool operator<(const CrsRecords& other) const { return this->tied() < other.tied(); }

private:
  std::tuple<const std::string&, const std::string&, const std::string&, const std::string&> tied()
    const
  {
    return std::tie(this->Text, this->Keys, this->Doubles, this->Ascii);
  }
};

} // namespace tipp

#endif
