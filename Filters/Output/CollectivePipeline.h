// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCollectivePipeline_h
#define tippCollectivePipeline_h

#include "vtkCompositeDataPipeline.h"
#include "vtkTIPPFiltersModule.h"

#include <functional>

class vtkMultiProcessController;

namespace tipp
{

/// The executive of a filter whose ranks execute together. If the upstream pipeline fails on one
/// rank, that rank would not execute, and the others would wait for it forever. So the ranks first
/// agree whether all can execute; otherwise the filter fails on all of them.
///
/// This costs one reduction per execution. All ranks must update the filter, which they must do
/// anyway.
class VTKTIPPFILTERS_EXPORT CollectivePipeline : public vtkCompositeDataPipeline
{
public:
  static CollectivePipeline* New();
  vtkTypeMacro(CollectivePipeline, vtkCompositeDataPipeline)

  /// Returns the filter's controller, or null; called before each execution.
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
