// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippUpdatedInput_h
#define tippUpdatedInput_h

class vtkAlgorithm;
class vtkDataObject;
class vtkInformation;

namespace tipp
{

/// Brings this rank's piece of a filter's input up to date before the pipeline asks for it, at the
/// time that `outInfo` asks for, if any. Null if the input fails.
vtkDataObject* updatedInput(vtkAlgorithm* filter, int rank, int ranks, vtkInformation* outInfo);

/// Asks a filter's input for a piece.
void askForPiece(vtkInformation* inInfo, int piece, int pieces);

} // namespace tipp

#endif
