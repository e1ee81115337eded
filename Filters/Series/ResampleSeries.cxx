// SPDX-License-Identifier: BSD-3-Clause
#include "Series/ResampleSeries.h"

#include "Files/IOError.h"
#include "Parallel/Stopwatch.h"
#include "Sampling/SamplingLattice.h"
#include "Series/ChosenTriangles.h"
#include "Series/SampleBoxes.h"

#include <algorithm>
#include <cmath>
#include <future>
#include <limits>
#include <memory>
#include <sstream>
#include <utility>

namespace tipp
{

std::string textOf(const Box2& box)
{
  std::ostringstream text;
  text << "x from " << box.Min.x << " to " << box.Max.x << ", y from " << box.Min.y << " to "
       << box.Max.y;
  return text.str();
}

namespace
{

void requireMeeting(const MeshSeries& series, const Box2& box, const SeriesRange& range)
{
  if (box.isEmpty())
  {
    throw IOError(series.Path, "has no triangles.");
  }
  if (range.Bounds && !range.Bounds->meets(box))
  {
    throw IOError(series.Path,
      "has nothing in --bounds: its nodes have " + textOf(box) +
        "; give xmin xmax ymin ymax in these units.");
  }
}

Box2 boundsOf(const SeriesNodes& nodes)
{
  Box2 box = Box2::empty();
  for (std::int64_t i = 0; i < nodes.size(); ++i)
  {
    const Point2 p = nodes[i];
    if (isFinite(p))
    {
      box.extend(p);
    }
  }
  return box;
}

Lattice latticeOf(const Box2& box, const SeriesRange& range)
{
  const Box2& of = range.Bounds ? *range.Bounds : box;
  const Box3 bounds{ { of.Min.x, of.Min.y, 0 }, { of.Max.x, of.Max.y, 0 } };
  const bool hasDelta = range.Delta[0] > 0 || range.Delta[1] > 0;
  const std::array<int, 3> dimensions = hasDelta
    ? std::array<int, 3>{ 1, 1, 1 }
    : chosenDimensions(bounds, { range.Dimensions[0], range.Dimensions[1], 1 }, true);
  return rangeLattice(bounds, dimensions, { range.Delta[0], range.Delta[1], 0 });
}

/// Reads the triangles that may claim samples of the lattice, which is set.
ChosenTriangles readTriangles(MeshSeries& series, const SeriesRange& range,
  const std::optional<Box2>& bounds, int threads, Lattice& grid)
{
  return ChosenTriangles(
    series,
    [&](const SeriesNodes& nodes) -> ChosenTriangles::Test
    {
      const Box2 box = bounds ? *bounds : boundsOf(nodes);
      if (box.isEmpty())
      {
        return [](const Box2&) { return false; };
      }
      grid = latticeOf(box, range);
      requireMemory(double(grid.samples()), 32 * double(grid.samples()));
      const auto boxes = std::make_shared<SampleBoxes>(grid);
      return [boxes](const Box2& triangle) { return boxes->mayHoldSamples(triangle); };
    },
    threads);
}

} // namespace

std::optional<SeriesSamples> findSamples(
  MeshSeries& series, const SeriesRange& range, int threads, const Report& progress)
{
  SeriesSamples samples;
  std::optional<ChosenTriangles> triangles;
  triangles.emplace(readTriangles(series, range, range.Bounds, threads, samples.Grid));
  const Box2 bounds = triangles->bounds();
  requireMeeting(series, bounds, range);
  const Lattice wanted = latticeOf(bounds, range);
  if (wanted.Min != samples.Grid.Min || wanted.Delta != samples.Grid.Delta ||
    wanted.Extent != samples.Grid.Extent) // there are nodes beyond all triangles
  {
    triangles.reset();
    triangles.emplace(readTriangles(series, range, bounds, threads, samples.Grid));
  }
  const SimplexMesh mesh = triangles->mesh();
  std::optional<KeptSamples> kept = KeptSamples::find(mesh, samples.Grid, threads, progress);
  if (!kept)
  {
    return std::nullopt;
  }
  samples.Kept = std::move(*kept);
  ChosenTriangles::Stored nodes =
    triangles->storedNodes(samples.Kept.keepPoints(std::max<std::int64_t>(mesh.PointCount, 1)));
  if (!nodes.Ranks.empty())
  {
    samples.Kept.renumberPoints(nodes.Ranks);
  }
  samples.Nodes = std::move(nodes.At);
  if (mesh.Cells > 0)
  {
    samples.Cells = triangles->storedCells(samples.Kept.keepCells(mesh.Cells));
  }
  return samples;
}

SeriesDescription describeSeries(
  const MeshSeries& series, const SeriesPlan& plan, const Lattice& grid)
{
  SeriesDescription description;
  description.Grid = grid;
  description.TimeUnits = series.TimeUnits;
  description.Calendar = series.Calendar;
  description.Crs = series.Crs;
  description.Source = series.Path;
  description.Threads = plan.Threads;
  for (const std::size_t step : plan.Steps)
  {
    description.Times.push_back(series.Times[step]);
  }
  for (const std::size_t i : plan.Variables)
  {
    const SeriesVariable& variable = series.Variables[i];
    const SeriesField field{ variable.Name, variable.LongName, variable.Units, variable.Varies,
      variable.StandardName };
    if (!variable.Varies || plan.WritesSteps)
    {
      description.Fields.push_back(field);
    }
    for (std::size_t k = 0; variable.Varies && k < plan.Reductions.size(); ++k)
    {
      description.Fields.push_back(plan.Reductions[k].fieldOf(
        field, series.TimeUnits, description.Times.empty() ? 0 : description.Times.front()));
    }
  }
  return description;
}

namespace
{

/// The run of resampleSeries().
class Run
{
public:
  Run(
    MeshSeries& series, const SeriesSamples& samples, const SeriesPlan& plan, SeriesOutput& output)
    : Series(series)
    , Samples(samples)
    , Plan(plan)
    , Output(output)
  {
    std::size_t field = 0;
    for (const std::size_t i : plan.Variables)
    {
      const bool varies = series.Variables[i].Varies;
      Job job{ i, field, {}, {} };
      field += !varies || plan.WritesSteps ? 1 : 0;
      for (std::size_t k = 0; varies && k < plan.Reductions.size(); ++k)
      {
        job.Reducers.emplace_back(
          plan.Reductions[k], std::size_t(samples.Kept.samples()), this->times());
        job.FieldsOfReducers.push_back(field++);
      }
      (varies ? this->Varying : this->Constant).push_back(std::move(job));
    }
  }

  std::optional<SeriesTimes> run()
  {
    this->readGround();
    const std::size_t steps = this->Varying.empty() ? 0 : this->Plan.Steps.size();
    const std::size_t most = this->samplesPairs() ? 2 : 1;
    for (std::size_t step = 0; step < steps; step += most)
    {
      for (Job& job : this->Varying)
      {
        this->Tasks.push_back({ &job, step, std::min(most, steps - step) });
      }
    }
    for (Job& job : this->Constant)
    {
      this->Tasks.push_back({ &job, 0 });
    }
    for (std::size_t i = 0; i < this->Tasks.size(); ++i)
    {
      if (this->Plan.Progress && !this->Plan.Progress(double(i) / double(this->Tasks.size())))
      {
        this->finishWriting();
        return std::nullopt;
      }
      this->doTask(i);
    }
    this->finishWriting();
    this->writeReductions();
    return this->Times;
  }

private:
  /// A variable, its fields in the output, and its reductions.
  struct Job
  {
    std::size_t Variable;
    std::size_t Field;
    std::vector<SeriesReducer> Reducers;
    std::vector<std::size_t> FieldsOfReducers;
  };

  /// The work on one step, or on two.
  struct Task
  {
    Job* Of;
    std::size_t Step; ///< index of SeriesPlan::Steps: the first one
    std::size_t Count = 1;
  };

  /// Whether two steps at a time are sampled. It takes more memory, so not for values that are more
  /// than the samples; and the output gets one step after another.
  bool samplesPairs() const
  {
    const bool areAtNodes = std::none_of(this->Varying.begin(), this->Varying.end(),
      [this](const Job& job) { return this->Series.Variables[job.Variable].OnCells; });
    return areAtNodes && this->Ground.empty() &&
      (this->Varying.size() == 1 || !this->Plan.WritesSteps) &&
      std::int64_t(this->Samples.Nodes.size()) <= this->Samples.Kept.samples();
  }

  std::vector<double> times() const
  {
    std::vector<double> times;
    for (const std::size_t step : this->Plan.Steps)
    {
      times.push_back(this->Series.Times[step]);
    }
    return times;
  }

  const std::vector<std::int32_t>& storedOf(std::size_t variable) const
  {
    return this->Series.Variables[variable].OnCells ? this->Samples.Cells : this->Samples.Nodes;
  }

  /// Reads the values of a task, in another thread: of two steps in turn, if it has two.
  std::vector<double> read(const Task& task)
  {
    const Stopwatch watch;
    std::vector<double> values = this->readStep(task, task.Step);
    if (task.Count == 2)
    {
      const std::vector<double> second = this->readStep(task, task.Step + 1);
      std::vector<double> both(2 * values.size());
      for (std::size_t i = 0; i < values.size(); ++i)
      {
        both[2 * i] = values[i];
        both[2 * i + 1] = second[i];
      }
      values = std::move(both);
    }
    this->Times.Reading += watch.seconds();
    return values;
  }

  std::vector<double> readStep(const Task& task, std::size_t index)
  {
    std::vector<double> values;
    const std::size_t step = this->Plan.Steps.empty() ? 0 : this->Plan.Steps[index];
    this->Series.readAt(task.Of->Variable, step, this->storedOf(task.Of->Variable), values);
    const std::string& name = this->Series.Variables[task.Of->Variable].Name;
    for (double& value : values)
    {
      value = value == this->Plan.NoData ? std::numeric_limits<double>::quiet_NaN() : value;
      if (std::isfinite(value) && std::isinf(float(value)))
      {
        throw IOError(this->Series.Path,
          "has " + std::to_string(value) + " in '" + name +
            "', which 32 bits do not hold; name other arrays with --arrays.");
      }
    }
    return values;
  }

  std::vector<double> nextValues(std::size_t i)
  {
    std::vector<double> values =
      this->Reading.valid() ? this->Reading.get() : this->read(this->Tasks[i]);
    if (i + 1 < this->Tasks.size())
    {
      this->Reading =
        std::async(std::launch::async, [this, i] { return this->read(this->Tasks[i + 1]); });
    }
    return values;
  }

  void doTask(std::size_t i)
  {
    const Task& task = this->Tasks[i];
    const std::vector<double> values = this->nextValues(i);
    std::vector<float>& samples = this->Buffers[i % 2];
    const auto ofStep = std::size_t(this->Samples.Kept.samples());
    samples.resize(task.Count * ofStep);
    Stopwatch watch;
    this->sample(task, values, samples.data());
    this->Times.Sampling += watch.seconds();
    watch.restart();
    for (std::size_t k = 0; k < task.Count; ++k)
    {
      this->reduce(task, task.Step + k, samples.data() + k * ofStep);
    }
    this->Times.Reducing += watch.seconds();
    this->finishWriting();
    const bool varies = this->Series.Variables[task.Of->Variable].Varies;
    if (!varies || this->Plan.WritesSteps)
    {
      this->Writing = std::async(std::launch::async,
        [this, &task, &samples, ofStep]
        {
          const Stopwatch watchOfWriting;
          for (std::size_t k = 0; k < task.Count; ++k)
          {
            this->Output.write(task.Of->Field, task.Step + k, samples.data() + k * ofStep);
          }
          this->Times.Writing += watchOfWriting.seconds();
        });
    }
  }

  void sample(const Task& task, const std::vector<double>& values, float* samples) const
  {
    const SeriesVariable& variable = this->Series.Variables[task.Of->Variable];
    const KeptSamples& kept = this->Samples.Kept;
    if (variable.OnCells)
    {
      kept.fromCells(values.data(), samples, this->Plan.Threads);
    }
    else if (task.Count == 2)
    {
      kept.pairFromPoints(values.data(), samples, samples + kept.samples(), this->Plan.Threads);
    }
    else if (variable.Varies && !this->Ground.empty())
    {
      kept.waterLevel(values.data(), this->Ground.data(), samples, this->Plan.Threads);
    }
    else
    {
      kept.fromPoints(values.data(), samples, this->Plan.Threads);
    }
  }

  void reduce(const Task& task, std::size_t step, const float* samples) const
  {
    if (task.Of->Reducers.empty())
    {
      return;
    }
    forChunks(this->Samples.Kept.samples(), 1 << 14, this->Plan.Threads, {},
      [&](std::int64_t begin, std::int64_t end, int)
      {
        for (SeriesReducer& reducer : task.Of->Reducers)
        {
          reducer.add(step, samples, std::size_t(begin), std::size_t(end));
        }
      });
  }

  void finishWriting()
  {
    if (this->Writing.valid())
    {
      this->Writing.get();
    }
  }

  void readGround()
  {
    if (!this->Plan.Depth)
    {
      return;
    }
    std::vector<double> depth;
    this->Series.readAt(*this->Plan.Depth, 0, this->Samples.Nodes, depth);
    for (double& value : depth)
    {
      value = -value;
    }
    this->Ground.resize(std::size_t(this->Samples.Kept.samples()));
    this->Samples.Kept.fromPoints(depth.data(), this->Ground.data(), this->Plan.Threads);
  }

  void writeReductions()
  {
    const Stopwatch watch;
    for (const Job& job : this->Varying)
    {
      for (std::size_t i = 0; i < job.Reducers.size(); ++i)
      {
        this->Output.write(job.FieldsOfReducers[i], 0, job.Reducers[i].result().data());
      }
    }
    this->Times.Writing += watch.seconds();
  }

  MeshSeries& Series;
  const SeriesSamples& Samples;
  const SeriesPlan& Plan;
  SeriesOutput& Output;
  SeriesTimes Times;
  std::vector<Job> Varying;
  std::vector<Job> Constant;
  std::vector<Task> Tasks;
  std::vector<float> Ground; ///< its elevation at the samples; empty: water ends at dry nodes
  std::vector<float> Buffers[2];
  std::future<std::vector<double>> Reading; ///< destroyed first: they use what is above
  std::future<void> Writing;
};

} // namespace

std::optional<SeriesTimes> resampleSeries(
  MeshSeries& series, const SeriesSamples& samples, const SeriesPlan& plan, SeriesOutput& output)
{
  return Run(series, samples, plan, output).run();
}

} // namespace tipp
