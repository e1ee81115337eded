// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCollectivePipeline_h
#define tippCollectivePipeline_h

#include "vtkCompositeDataPipeline.h"
#include "vtkTIPPFiltersModule.h"

#include <functional>

class vtkMultiProcessController;

namespace tipp
{

/// The executive of a filter whose ranks execute together. If on one rank what is upstream fails,
/// that rank would never come to execute and the others would wait for it for ever; so before they
/// execute the ranks agree whether all can, and else the filter fails on all of them.
///
/// This costs a reduction for each execution. All ranks must update the filter, as they must
/// anyway.
class VTKTIPPFILTERS_EXPORT CollectivePipeline : public vtkCompositeDataPipeline
{
public:
  static CollectivePipeline* New();
  vtkTypeMacro(CollectivePipeline, vtkCompositeDataPipeline)

  /// Asked for the filter's controller before each execution; may give null.
  std::function<vtkMultiProcessController*()> Controller;

protected:
  CollectivePipeline() = default;
  ~CollectivePipeline() override = default;

  using vtkCompositeDataPipeline::ForwardUpstream;
  int ForwardUpstream(vtkInformation* request) override;

private:
  CollectivePipeline(const CollectivePipeline&) = delete;
  void operator=(const CollectivePipeline&) = delete;
};

} // namespace tipp

#endif
