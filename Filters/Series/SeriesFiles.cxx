// SPDX-License-Identifier: BSD-3-Clause
#include "Series/SeriesFiles.h"

#include "Dem/RasterTiles.h"
#include "Files/Formats.h"
#include "Files/IOError.h"
#include "Files/VtkXml.h"
#include "Npy/NpyFile.h"
#include "Raster/RasterFile.h"
#include "Sampling/ImageFile.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <set>
#include <utility>

namespace tipp
{
namespace
{

namespace fs = std::filesystem;

/// The path of a step's file.
std::string stepPath(const std::string& path, std::size_t number, const std::string& extension)
{
  char digits[32];
  std::snprintf(digits, sizeof digits, "_%04zu", number);
  const fs::path file(path);
  return (file.parent_path() / (file.stem().string() + digits + extension)).string();
}

/// Which fields are in a file.
std::vector<std::size_t> fieldsOf(const SeriesDescription& of, bool varying)
{
  std::vector<std::size_t> fields;
  for (std::size_t i = 0; i < of.Fields.size(); ++i)
  {
    if (of.Fields[i].Varies == varying)
    {
      fields.push_back(i);
    }
  }
  return fields;
}

/// Writes a file for each step, and one for the fields that do not vary.
class FilePerStep : public SeriesOutput
{
public:
  FilePerStep(const SeriesDescription& description, std::vector<std::string> paths,
    std::vector<PathState> before)
    : Of(description)
    , Paths(std::move(paths))
    , Before(std::move(before))
    , Samples(description.Fields.size())
    , Work(WorkFolder::beside(this->Paths.back()))
  {
  }

  void write(std::size_t field, std::size_t step, const float* samples) final
  {
    this->Samples[field].assign(samples, samples + this->Of.Grid.samples());
    const bool varies = this->Of.Fields[field].Varies;
    const std::vector<std::size_t> fields = fieldsOf(this->Of, varies);
    if (std::none_of(
          fields.begin(), fields.end(), [this](std::size_t i) { return this->Samples[i].empty(); }))
    {
      const bool hasSteps = !fieldsOf(this->Of, true).empty();
      const std::size_t file = varies ? step : hasSteps ? this->Of.Times.size() : 0;
      this->writeFile(this->finished(file), fields);
      this->Finished.push_back(file);
      for (const std::size_t i : fields)
      {
        this->Samples[i].clear();
      }
    }
  }

  /// Moves all files to their paths.
  void close() override
  {
    for (const std::size_t file : this->Finished)
    {
      publishFile(this->finished(file), this->Paths[file], this->Before[file]);
    }
  }

protected:
  virtual void writeFile(const std::string& path, const std::vector<std::size_t>& fields) = 0;

  /// Where a file is until all are complete. WorkFolder removes files of such names.
  std::string finished(std::size_t file) const
  {
    return this->Work.path() + "/." + std::to_string(file) + ".tmp";
  }

  const SeriesDescription Of;
  const std::vector<std::string> Paths;
  const std::vector<PathState> Before;
  std::vector<std::vector<float>> Samples; ///< by field, of the step that is written next

private:
  WorkFolder Work;
  std::vector<std::size_t> Finished; ///< the files that are written
};

class GeoTiffs : public FilePerStep
{
public:
  using FilePerStep::FilePerStep;

private:
  void writeFile(const std::string& path, const std::vector<std::size_t>& fields) override
  {
    RasterDescription raster;
    raster.Grid = pixelsOf(this->Of.Grid);
    raster.Crs = this->Of.Crs;
    raster.NoData = this->Of.NoData;
    raster.Threads = this->Of.Threads;
    BandValues bands;
    for (const std::size_t field : fields)
    {
      raster.Bands.push_back(this->Of.Fields[field].Name);
      bands.emplace_back(this->Samples[field].begin(), this->Samples[field].end());
    }
    const auto writer = createGeoTiff(path, raster, PathState());
    writeTiles(*writer, raster.Grid, readFrom(raster.Grid, bands), {}, raster.Threads);
    if (writer->hidden() > 0)
    {
      throw IOError(
        path, "would lose values that equal the number for no value; give another --null.");
    }
    writer->close();
  }
};

/// .vti files, and the .pvd that lists them with their times.
class ParaViewFiles : public FilePerStep
{
public:
  ParaViewFiles(const std::string& path, const SeriesDescription& description,
    const std::vector<std::string>& paths, const std::vector<PathState>& before)
    : FilePerStep(description, paths, before)
    , List(path, before.back())
  {
  }

  void close() override
  {
    FilePerStep::close();
    std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n"
                       "<Collection>\n";
    // Without fields that vary there is one file.
    const bool hasSteps = !fieldsOf(this->Of, true).empty();
    const std::vector<double> times = hasSteps ? this->Of.Times : std::vector<double>{ 0 };
    for (std::size_t i = 0; i < times.size(); ++i)
    {
      char time[64];
      std::snprintf(time, sizeof time, "%.17g", times[i]);
      text += "<DataSet timestep=\"" + std::string(time) + "\" file=\"" +
        escapedXml(fs::path(this->Paths[i]).filename().string()) + "\"/>\n";
    }
    text += "</Collection>\n</VTKFile>\n";
    this->List.file().write(0, text.data(), text.size());
    this->List.commit();
  }

private:
  void writeFile(const std::string& path, const std::vector<std::size_t>& fields) override
  {
    ImageArrays image;
    image.Grid = this->Of.Grid;
    image.Grid.Min[2] = 0;
    image.Grid.Delta[2] = 1;
    for (const std::size_t field : fields)
    {
      image.OfPoints.push_back(
        { this->Of.Fields[field].Name, Scalar::Float32, 1, this->Samples[field].data() });
    }
    writeVti(path, std::nullopt, image);
  }

  PendingFile List;
};

class NpySeries : public SeriesOutput
{
public:
  NpySeries(const std::string& path, const SeriesDescription& of, const PathState& before)
    : Bytes(std::size_t(of.Grid.samples()) * sizeof(float))
    , Writer(path, "<f4", shapeOf(of), before)
  {
  }

  void write(std::size_t, std::size_t, const float* samples) override
  {
    this->Writer.write(samples, this->Bytes);
  }
  void close() override { this->Writer.close(); }

private:
  static std::vector<std::int64_t> shapeOf(const SeriesDescription& of)
  {
    std::vector<std::int64_t> shape = { of.Grid.size(1), of.Grid.size(0) };
    if (of.Fields[0].Varies && !of.IsOneStep)
    {
      shape.insert(shape.begin(), std::int64_t(of.Times.size()));
    }
    return shape;
  }

  const std::size_t Bytes;
  NpyWriter Writer;
};

} // namespace

SeriesFiles::SeriesFiles(
  std::string path, SeriesDescription description, std::vector<std::size_t> numbers)
  : Path(std::move(path))
  , Of(std::move(description))
  , Numbers(std::move(numbers))
{
  if (this->Of.Fields.empty())
  {
    throw IOError(this->Path, "would have no field; name arrays of the mesh.");
  }
  std::set<std::string> names;
  if (openerOf(this->Path, Use::WritesSeries) == Opener::Netcdf)
  {
    names = { "crs", "lat", "lon", "time", "x", "y" };
  }
  for (const SeriesField& field : this->Of.Fields)
  {
    if (!names.insert(field.Name).second)
    {
      throw IOError(this->Path,
        "would have the name '" + field.Name +
          "' twice; give each array and each --reduce once, or name the arrays with --arrays.");
    }
  }
  if (openerOf(this->Path, Use::WritesSeries) == Opener::Npy && this->Of.Fields.size() > 1)
  {
    throw IOError(this->Path,
      "holds one array, and there would be " + std::to_string(this->Of.Fields.size()) +
        "; name one with --arrays, with one --reduce or none, or write .nc.");
  }
}

std::vector<std::string> SeriesFiles::paths() const
{
  const Opener opener = openerOf(this->Path, Use::WritesSeries);
  const bool hasSteps = !fieldsOf(this->Of, true).empty();
  const bool hasOthers = !fieldsOf(this->Of, false).empty();
  const bool isTiff = opener == Opener::GeoTiff;
  if (opener == Opener::Netcdf || opener == Opener::Npy ||
    (isTiff && (!hasSteps || (this->Numbers.size() == 1 && !hasOthers))))
  {
    return { this->Path };
  }
  std::vector<std::string> paths;
  for (const std::size_t number : hasSteps ? this->Numbers : std::vector<std::size_t>())
  {
    paths.push_back(stepPath(this->Path, number, isTiff ? extensionOf(this->Path) : ".vti"));
  }
  if (hasOthers)
  {
    paths.push_back(isTiff ? this->Path : fs::path(this->Path).replace_extension(".vti").string());
  }
  if (!isTiff)
  {
    paths.push_back(this->Path);
  }
  return paths;
}

std::unique_ptr<SeriesOutput> SeriesFiles::create(const std::vector<PathState>& before) const
{
  switch (openerOf(this->Path, Use::WritesSeries))
  {
    case Opener::Netcdf:
      return createNetcdfSeries(this->Path, this->Of, before.front());
    case Opener::Npy:
      return std::make_unique<NpySeries>(this->Path, this->Of, before.front());
    case Opener::GeoTiff:
      return std::make_unique<GeoTiffs>(this->Of, this->paths(), before);
    default:
      return std::make_unique<ParaViewFiles>(this->Path, this->Of, this->paths(), before);
  }
}

} // namespace tipp
