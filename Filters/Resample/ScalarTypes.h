// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippScalarTypes_h
#define tippScalarTypes_h

#include "Resample/Attribute.h"

#include <optional>

namespace tipp
{

/// The kind of numbers of a VTK_... type; nothing for bits and what is no number.
std::optional<Scalar> scalarOf(int vtkType);

} // namespace tipp

#endif
