// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file vtkTIPPSetGet.h
 * @brief macros for the properties of VTK classes, beside those of vtkSetGet.h
 */

#ifndef vtkTIPPSetGet_h
#define vtkTIPPSetGet_h

#include "vtkIndent.h"
#include "vtkSetGet.h"
#include "vtkWrappingHints.h"

#include <string>
#include <type_traits>

/// Declares SetName(), GetName(), NameOn() and NameOff().
#define vtkTIPPSwitchMacro(name, type)                                                             \
  vtkSetMacro(name, type);                                                                         \
  vtkGetMacro(name, type);                                                                         \
  vtkBooleanMacro(name, type)

/// Declares SetName(), which clamps the value to [min, max], and GetName().
#define vtkTIPPClampedMacro(name, type, min, max)                                                  \
  vtkSetClampMacro(name, type, min, max);                                                          \
  vtkGetMacro(name, type)

/// Defines SetName() and GetName() of a std::string. Null stands for the empty string. `hint` is
/// VTK_FILEPATH for paths.
#define vtkTIPPHintedStringMacro(name, hint)                                                       \
  virtual void Set##name(hint const char* value)                                                   \
  {                                                                                                \
    const std::string text = value ? value : "";                                                   \
    if (this->name != text)                                                                        \
    {                                                                                              \
      this->name = text;                                                                           \
      this->Modified();                                                                            \
    }                                                                                              \
  }                                                                                                \
  virtual hint const char* Get##name() const                                                       \
  {                                                                                                \
    return this->name.empty() ? nullptr : this->name.c_str();                                      \
  }
#define vtkTIPPStringMacro(name) vtkTIPPHintedStringMacro(name, )
#define vtkTIPPFilePathMacro(name) vtkTIPPHintedStringMacro(name, VTK_FILEPATH)

/// Defines the access to a std::vector<std::string> called Names: AddName(), which ignores null and
/// an empty string, SetName(), which replaces all by one, ClearNames(), GetNumberOfNames(), and
/// GetName(), which returns null if there is no such index.
#define vtkTIPPNameListMacro(name)                                                                 \
  virtual void Add##name(const char* value)                                                        \
  {                                                                                                \
    if (value && *value)                                                                           \
    {                                                                                              \
      this->name##s.emplace_back(value);                                                           \
      this->Modified();                                                                            \
    }                                                                                              \
  }                                                                                                \
  virtual void Set##name(const char* value)                                                        \
  {                                                                                                \
    if (!value || this->name##s.size() != 1 || this->name##s.front() != value)                     \
    {                                                                                              \
      const std::string only = value ? value : "";                                                 \
      this->Clear##name##s();                                                                      \
      this->Add##name(only.c_str());                                                               \
    }                                                                                              \
  }                                                                                                \
  virtual void Clear##name##s()                                                                    \
  {                                                                                                \
    if (!this->name##s.empty())                                                                    \
    {                                                                                              \
      this->name##s.clear();                                                                       \
      this->Modified();                                                                            \
    }                                                                                              \
  }                                                                                                \
  virtual int GetNumberOf##name##s() const                                                         \
  {                                                                                                \
    return int(this->name##s.size());                                                              \
  }                                                                                                \
  virtual const char* Get##name(int index) const                                                   \
  {                                                                                                \
    return index >= 0 && index < int(this->name##s.size())                                         \
      ? this->name##s[std::size_t(index)].c_str()                                                  \
      : nullptr;                                                                                   \
  }

/// Prints a property in PrintSelf().
#define vtkTIPPPrintMacro(name) tipp::printProperty(os, indent, #name, this->name)

namespace tipp
{

/// Prints a line with the name and the value of a property: a number, a switch, a std::string, or
/// an array or vector of these.
template <typename Value>
void printProperty(ostream& os, vtkIndent indent, const char* name, const Value& value)
{
  os << indent << name << ":";
  if constexpr (std::is_same_v<Value, std::string>)
  {
    os << " " << (value.empty() ? "(none)" : value);
  }
  else if constexpr (std::is_same_v<Value, bool>)
  {
    os << (value ? " On" : " Off");
  }
  else if constexpr (std::is_array_v<Value> || std::is_class_v<Value>)
  {
    for (const auto& item : value)
    {
      os << " " << item;
    }
  }
  else
  {
    os << " " << value;
  }
  os << "\n";
}

} // namespace tipp

#endif
