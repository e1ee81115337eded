// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippLazText_h
#define tippLazText_h

#include "LasText.h"
#include "LazInputs.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace tipp::test
{

/// The bytes of a file, and those of the same points compressed.
struct LasAndLaz
{
  std::string Plain;
  std::string Compressed;
  std::size_t PointOffset = 0; ///< of the compressed file
};

template <typename T>
void putAt(std::string& text, std::size_t at, T value)
{
  std::memcpy(&text[at], &value, sizeof value);
}

inline std::string textOfDigits(const std::string& digits)
{
  std::string text;
  for (std::size_t i = 0; i < digits.size(); i += 2)
  {
    text.push_back(char(std::stoi(digits.substr(i, 2), nullptr, 16)));
  }
  return text;
}

inline void putCount(std::string& text, int format, std::size_t count)
{
  putAt(text, 107, std::uint32_t(format < 6 ? count : 0));
  if (format >= 6)
  {
    putAt(text, 247, std::uint64_t(count));
  }
}

inline LasAndLaz filesOf(const LazInput& input)
{
  LasAndLaz files;
  LasText las(input.Format >= 6 ? 4 : input.Format >= 4 ? 3 : 2, input.Format);
  las.header(105, std::uint16_t(recordOf(input.Format, 0).size()));
  files.Plain = las.text();
  putCount(files.Plain, input.Format, lazInputPoints);
  for (std::size_t i = 0; i < lazInputPoints; ++i)
  {
    const std::vector<std::uint8_t> record = recordOf(input.Format, i);
    files.Plain.append(record.begin(), record.end());
  }
  const std::string content = textOfDigits(input.Record);
  std::string record(54, '\0');
  record.replace(2, 14, "laszip encoded");
  putAt(record, 18, std::uint16_t(22204));
  putAt(record, 20, std::uint16_t(content.size()));
  las.addBytes(record + content);
  las.header(100, std::uint32_t(1));
  las.header(104, std::uint8_t(128 + input.Format));
  files.Compressed = las.text();
  putCount(files.Compressed, input.Format, lazInputPoints);
  files.PointOffset = files.Compressed.size();
  std::string data = textOfDigits(input.Data);
  std::uint64_t table = 0;
  std::memcpy(&table, data.data(), sizeof table);
  putAt(data, 0, table + files.PointOffset);
  files.Compressed += data;
  return files;
}

} // namespace tipp::test

#endif
