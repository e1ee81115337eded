// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRunSetup3_h
#define tippRunSetup3_h

#include "Files/IOError.h"
#include "OutOfCore/OutOfCoreOptions.h"
#include "OutOfCore/PiecePlan3.h"
#include "OutOfCore/PieceRun3.h"
#include "OutOfCore/RunSetup.h"

#include <memory>
#include <string>
#include <vector>

namespace tipp
{

/// What RunSetup is in the plane.
class RunSetup3 : public RunSetupOf<PiecePlan3>
{
public:
  explicit RunSetup3(const OutOfCoreRunOptions& /*options*/ = {}) { this->Mesh.CellSize = 4; }

  /// See RunSetup. Throws IOError also if there is no column with the third coordinate.
  void describeColumns(const std::vector<std::string>& columns, const OutOfCoreRunOptions& options)
  {
    const std::size_t elevation = findElevation(columns);
    if (elevation == columns.size())
    {
      throw IOError("The input has no column z, Z or elevation, the third coordinate.");
    }
    tipp::describeColumns(columns, elevation, options, this->Rows, this->Mesh);
  }

  void save(SaveArchive& archive)
  {
    archive(this->Survey, this->Rows, this->Mesh.Arrays);
    this->Plan->save(archive);
    this->Spilled->save(archive);
  }
  void load(LoadArchive& archive, const std::string& points)
  {
    archive(this->Survey, this->Rows, this->Mesh.Arrays);
    this->Plan = std::make_unique<PiecePlan3>(archive);
    this->loadPoints(archive, points);
  }

  void beginTaking() const {} // tetrahedra are always written to a mesh

  MemoryPlan3 memory(const OutOfCoreRunOptions& options) const
  {
    return { options.MemoryLimit, options.PiecePoints, std::size_t(this->Rows.Words) };
  }

  PieceWork3 work() const
  {
    return { *this->Plan, *this->Spilled, this->Rows, this->Mesh, this->Results,
      this->Survey.Factor };
  }
};

} // namespace tipp

#endif
