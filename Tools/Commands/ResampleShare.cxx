// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/ResampleShare.h"

#include "vtkCellData.h"
#include "vtkDataSet.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>

namespace tipp
{

void hideOtherShares(vtkDataSet* mesh, const Ranks& ranks)
{
  if (ranks.count() == 1)
  {
    return;
  }
  const vtkIdType cells = mesh->GetNumberOfCells();
  vtkNew<vtkUnsignedCharArray> ghosts;
  if (vtkUnsignedCharArray* const own = mesh->GetCellGhostArray())
  {
    ghosts->DeepCopy(own);
  }
  else
  {
    ghosts->SetNumberOfValues(cells);
    ghosts->FillValue(0);
  }
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  const auto [first, last] = ranks.shareOf(cells);
  unsigned char* const values = ghosts->GetPointer(0);
  const auto hide = [](unsigned char& ghost)
  { ghost = (unsigned char)(ghost | vtkDataSetAttributes::HIDDENCELL); };
  std::for_each(values, values + first, hide);
  std::for_each(values + last, values + cells, hide);
  mesh->GetCellData()->AddArray(ghosts);
}

std::string associationsOf(
  const std::vector<std::string>& arrays, vtkDataSet* mesh, const Ranks& ranks)
{
  std::string mine;
  for (const std::string& name : arrays)
  {
    mine += mesh->GetPointData()->HasArray(name.c_str()) ? 'p'
      : mesh->GetCellData()->HasArray(name.c_str())      ? 'c'
                                                         : ' ';
  }
  std::string known(arrays.size(), ' ');
  for (const std::string& associations : ranks.gather(mine))
  {
    for (std::size_t i = 0; i < known.size(); ++i)
    {
      known[i] = known[i] == ' ' ? associations[i] : known[i];
    }
  }
  return known;
}

} // namespace tipp
