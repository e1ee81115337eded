// SPDX-License-Identifier: BSD-3-Clause
#include "Vtk/ArrayNames.h"

#include "vtkAbstractArray.h"
#include "vtkFieldData.h"

namespace tipp
{

std::set<std::string> arrayNames(vtkFieldData* data)
{
  std::set<std::string> names;
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    const char* const name = data->GetAbstractArray(i)->GetName();
    if (name && *name)
    {
      names.insert(name);
    }
  }
  return names;
}

std::string listOfNames(const std::set<std::string>& names, const std::string& intro)
{
  constexpr std::size_t most = 20;
  std::string text = intro;
  std::size_t listed = 0;
  for (const std::string& name : names)
  {
    if (listed == most)
    {
      return text + " and " + std::to_string(names.size() - most) + " more";
    }
    text += (listed++ == 0 ? "'" : ", '") + name + "'";
  }
  return names.empty() ? text + "none" : text;
}

} // namespace tipp
