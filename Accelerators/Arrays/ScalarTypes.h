// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippScalarTypes_h
#define tippScalarTypes_h

#include "Arrays/Scalar.h"
#include "vtkTIPPAcceleratorsModule.h"

#include <optional>

namespace tipp
{

/// The Scalar of a VTK_... type; nullopt for bits and types that are not numeric.
VTKTIPPACCELERATORS_EXPORT std::optional<Scalar> scalarOf(int vtkType);

/// The inverse of scalarOf().
VTKTIPPACCELERATORS_EXPORT int vtkTypeOf(Scalar type);

} // namespace tipp

#endif
