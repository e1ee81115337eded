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

} // namespace tipp
