// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippFlatUgrid_h
#define tippFlatUgrid_h

#include "Flat/FlatMesh.h"
#include "Series/WriteUgrid.h"
#include "vtkTIPPIOModule.h"

#include <string>

namespace tipp
{

/// The content of a mesh of triangles for writeUgrid(). Components of an array become arrays with
/// _0, _1 ... after its name; the third coordinate is "elevation", unless an array has that name.
/// `content` must outlive the result. Throws IOError with the path of the mesh, `source`, if it has
/// tetrahedra.
VTKTIPPIO_EXPORT UgridContent ugridOf(const FlatContent& content, const std::string& source);

} // namespace tipp

#endif
