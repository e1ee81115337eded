// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippUpdatedInput_h
#define tippUpdatedInput_h

class vtkAlgorithm;
class vtkDataObject;
class vtkInformation;

namespace tipp
{

/// Updates this rank's piece of a filter's input before the pipeline requests it, at the time step
/// that `outInfo` requests, if any. Returns null if the input fails.
vtkDataObject* updatedInput(vtkAlgorithm* filter, int rank, int ranks, vtkInformation* outInfo);

/// Requests a piece of a filter's input.
void askForPiece(vtkInformation* inInfo, int piece, int pieces);

} // namespace tipp

#endif
