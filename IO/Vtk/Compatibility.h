// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCompatibility_h
#define tippCompatibility_h

// Differences between the VTK releases that TIPP is built against, from 9.1 to 9.7.

#include "vtkAlgorithm.h"
#include "vtkSmartPointer.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"
#include "vtkVersionMacros.h"

// VTK 9.3 and ParaView 5.11 have vtkAlgorithm::CheckAbort() and do not change AbortExecute; earlier
// ones reset it when an execution begins.
#define TIPP_VTK_CHECKS_ABORT (VTK_VERSION_NUMBER > VTK_VERSION_CHECK(9, 2, 20221101))

// VTK 9.4 stores the faces of polyhedra in cell arrays.
#define TIPP_VTK_FACES_ARE_CELLS (VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 4, 0))

namespace tipp
{

/// Whether the user has asked the running algorithm to stop; since VTK 9.3 also through a filter
/// upstream.
inline bool abortRequested(vtkAlgorithm* algorithm)
{
#if TIPP_VTK_CHECKS_ABORT
  return algorithm->CheckAbort();
#else
  return algorithm->GetAbortExecute() != 0;
#endif
}

/// Forgets an earlier abort as VTK's pipeline does, for executions outside of it.
inline void beginExecution(vtkAlgorithm* algorithm)
{
#if TIPP_VTK_CHECKS_ABORT
  algorithm->SetAbortOutput(false); // CheckAbort() keeps its answer here
#else
  algorithm->SetAbortExecute(0);
#endif
}

/// The cell types as the grid stores them: in VTK 9.6 that may be an implicit array.
inline vtkDataArray* storedCellTypes(vtkUnstructuredGrid* grid)
{
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 6, 0)
  return grid->GetCellTypes();
#else
  return grid->GetCellTypesArray();
#endif
}

/// The type of each cell in contiguous memory; null if the grid has none.
inline vtkSmartPointer<vtkUnsignedCharArray> cellTypes(vtkUnstructuredGrid* grid)
{
  vtkDataArray* const types = storedCellTypes(grid);
  vtkSmartPointer<vtkUnsignedCharArray> result = vtkUnsignedCharArray::SafeDownCast(types);
  if (!result && types)
  {
    result = vtkSmartPointer<vtkUnsignedCharArray>::New();
    result->DeepCopy(types);
  }
  return result;
}

/// Allocates without throwing; false if there is not enough memory.
inline bool reserveTuples(vtkAbstractArray* array, vtkIdType tuples)
{
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 7, 0)
  return array->ReserveTuples(tuples) != 0;
#else
  return array->Resize(tuples) != 0;
#endif
}

} // namespace tipp

#endif
