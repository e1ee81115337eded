// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippScalarTypes_h
#define tippScalarTypes_h

#include "Arrays/Scalar.h"
#include "vtkTIPPAcceleratorsModule.h"

#include <optional>

namespace tipp
{

/// The kind of numbers of a VTK_... type; nothing for bits and what is no number.
VTKTIPPACCELERATORS_EXPORT std::optional<Scalar> scalarOf(int vtkType);

/// The other way round.
VTKTIPPACCELERATORS_EXPORT int vtkTypeOf(Scalar type);

} // namespace tipp

#endif
