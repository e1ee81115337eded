// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPieceSource_h
#define tippPieceSource_h

#include "RangeResampleTesting.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkUnstructuredGridAlgorithm.h"

/// A source whose piece i of n has each n-th cell of a scene, from cell i on.
class PieceSource : public vtkUnstructuredGridAlgorithm
{
public:
  static PieceSource* New() { VTK_STANDARD_NEW_BODY(PieceSource); }
  Scene Cells;
  int Requests = 0;
  double Time = 0; ///< time of the last request
  int FailingPiece = -1;

protected:
  PieceSource() { this->SetNumberOfInputPorts(0); }

  int RequestInformation(
    vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) override
  {
    vtkInformation* const info = outputs->GetInformationObject(0);
    info->Set(CAN_HANDLE_PIECE_REQUEST(), 1);
    const double times[] = { 0, 3 };
    info->Set(vtkStreamingDemandDrivenPipeline::TIME_STEPS(), times, 2);
    return 1;
  }

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) override
  {
    vtkInformation* const info = outputs->GetInformationObject(0);
    this->Time = info->Get(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP());
    const int piece = info->Get(vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER());
    const int pieces = info->Get(vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_PIECES());
    ++this->Requests;
    if (piece == this->FailingPiece)
    {
      return 0;
    }
    vtkUnstructuredGrid::GetData(outputs)->ShallowCopy(gridOf(this->Cells, piece, pieces));
    return 1;
  }
};

#endif
