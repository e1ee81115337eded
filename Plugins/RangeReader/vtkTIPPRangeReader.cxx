// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTIPPRangeReader.h"

#include "vtkMath.h"
#include "vtkObjectFactory.h"

#include <algorithm>

vtkStandardNewMacro(vtkTIPPRangeReader);

void vtkTIPPRangeReader::SetUseRange(bool use)
{
  this->UseRange = use;
  this->UpdateBounds();
}

void vtkTIPPRangeReader::SetRangePosition(double x, double y, double z)
{
  const double position[] = { x, y, z };
  std::copy_n(position, 3, this->RangePosition);
  this->UpdateBounds();
}

void vtkTIPPRangeReader::SetRangeScale(double x, double y, double z)
{
  const double scale[] = { x, y, z };
  std::copy_n(scale, 3, this->RangeScale);
  this->UpdateBounds();
}

void vtkTIPPRangeReader::UpdateBounds()
{
  double bounds[6];
  vtkMath::UninitializeBounds(bounds); // everything
  for (int axis = 0; axis < 3 && this->UseRange; ++axis)
  {
    const double begin = this->RangePosition[axis];
    const double end = begin + this->RangeScale[axis];
    bounds[2 * axis] = std::min(begin, end);
    bounds[2 * axis + 1] = std::max(begin, end);
  }
  this->SetBounds(bounds); // modified only if they change
}

void vtkTIPPRangeReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const double* const p = this->RangePosition;
  const double* const s = this->RangeScale;
  os << indent << "UseRange: " << this->UseRange << "\n";
  os << indent << "RangePosition: " << p[0] << " " << p[1] << " " << p[2] << "\n";
  os << indent << "RangeScale: " << s[0] << " " << s[1] << " " << s[2] << "\n";
}
