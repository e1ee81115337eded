// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippVariableNames_h
#define tippVariableNames_h

#include <algorithm>
#include <string>

namespace tipp
{

/// Whether one of the variables or arrays has this name.
template <typename Variables>
bool isTaken(const Variables& variables, const std::string& name)
{
  return std::any_of(variables.begin(), variables.end(),
    [&name](const auto& variable) { return variable.Name == name; });
}

/// A name for an array at cells that no array at points has.
template <typename Variables>
std::string freeName(const Variables& variables, std::string name)
{
  while (isTaken(variables, name))
  {
    name += "_cells";
  }
  return name;
}

/// The name for the third coordinates of the points among other arrays.
template <typename Variables>
std::string heightName(const Variables& variables)
{
  std::string name = isTaken(variables, "elevation") ? "z" : "elevation";
  while (isTaken(variables, name))
  {
    name += "_points";
  }
  return name;
}

} // namespace tipp

#endif
