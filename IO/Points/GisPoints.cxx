// SPDX-License-Identifier: BSD-3-Clause
#include "Points/ReadPoints.h"

#include "Files/IOError.h"
#include "Files/InputFile.h"
#ifdef TIPP_HAVE_GDAL
#include "Crs/ImportCrs.h"
#include "Files/TextFile.h"
#include "Gdal/GdalLibrary.h"
#include "Predicates/Geometry.h"
#endif

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace tipp
{

#ifdef TIPP_HAVE_GDAL

namespace
{

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// What a pass over the points of a file has found.
struct GisSurvey
{
  std::int64_t Points = 0;
  std::int64_t Flat = 0;         ///< points without a z
  std::int64_t WithoutPoint = 0; ///< features that are no points
  std::int64_t Texts = 0;        ///< texts of a drawing, which have a position
  bool HasZ = false;
  bool HasNonzeroZ = false;
  bool IsBeyondDegrees = false;
  std::vector<std::string> Attributes; ///< those of numbers, in all layers with points
  CrsRecords Crs;
  bool IsGeographic = false;
};

/// The points of a file, feature by feature, in its order.
class GisFeatures
{
public:
  GisFeatures(const std::string& path, std::string layer)
    : Path(path)
    , LayerName(std::move(layer))
    , IsDrawing(extensionOf(path) == ".dxf")
    , File(openWithGdal(path, GDAL_OF_VECTOR))
  {
    if (!this->File)
    {
      throw IOError(path,
        "cannot be read as points of a GIS (" + shownText(gdal().CPLGetLastErrorMsg()) + ").");
    }
    this->requireLayer();
  }

  /// Goes to the next feature that is asked for; returns false at the end. Throws IOError.
  bool next()
  {
    for (; this->LayerIndex < this->layers(); ++this->LayerIndex)
    {
      if (!this->Layer && this->isWanted(this->LayerIndex))
      {
        this->Layer = gdal().GDALDatasetGetLayer(this->File.get(), this->LayerIndex);
        gdal().OGR_L_ResetReading(this->Layer);
        this->Columns.clear();
      }
      while (this->Layer)
      {
        gdal().CPLErrorReset();
        this->Feature.reset(gdal().OGR_L_GetNextFeature(this->Layer));
        if (!this->Feature)
        {
          this->requireWhole();
          this->Layer = nullptr;
        }
        else if (!this->IsDrawing || this->LayerName.empty() ||
          this->text("Layer") == this->LayerName)
        {
          return true;
        }
      }
    }
    return false;
  }

  OGRLayerH layer() const { return this->Layer; }
  bool isText() const { return this->IsDrawing && !this->text("Text").empty(); }

  /// Calls take(x, y, z) for each point of the feature, z being NaN if there is none.
  template <typename Take>
  void forPoints(const Take& take) const
  {
    const OGRGeometryH geometry = gdal().OGR_F_GetGeometryRef(this->Feature.get());
    if (geometry && !this->isText())
    {
      forPointsOf(geometry, take);
    }
  }

  /// Returns the value of an attribute; NaN if it is missing.
  double attribute(const std::string& name)
  {
    const auto found = this->Columns.find(name);
    const int column = found != this->Columns.end()
      ? found->second
      : this->Columns.emplace(name, gdal().OGR_F_GetFieldIndex(this->Feature.get(), name.c_str()))
          .first->second;
    return column >= 0 && gdal().OGR_F_IsFieldSetAndNotNull(this->Feature.get(), column) != 0
      ? gdal().OGR_F_GetFieldAsDouble(this->Feature.get(), column)
      : none;
  }

private:
  /// Throws IOError if reading a feature failed.
  void requireWhole() const
  {
    if (gdal().CPLGetLastErrorType() >= CE_Failure)
    {
      throw IOError(this->Path, "is damaged (" + shownText(gdal().CPLGetLastErrorMsg()) + ").");
    }
  }

  int layers() const { return gdal().GDALDatasetGetLayerCount(this->File.get()); }

  std::string nameOf(int layer) const
  {
    return gdal().OGR_L_GetName(gdal().GDALDatasetGetLayer(this->File.get(), layer));
  }

  /// The layers of a drawing are an attribute.
  bool isWanted(int layer) const
  {
    return this->IsDrawing || this->LayerName.empty() || this->nameOf(layer) == this->LayerName;
  }

  void requireLayer() const
  {
    std::set<std::string> names;
    for (int layer = 0; layer < this->layers(); ++layer)
    {
      if (this->isWanted(layer))
      {
        return;
      }
      names.insert(this->nameOf(layer));
    }
    throw IOError(this->Path,
      "has no layer '" + this->LayerName + "'" + listOfNames(names, "; there are ") + ".");
  }

  std::string text(const char* field) const
  {
    const int column = gdal().OGR_F_GetFieldIndex(this->Feature.get(), field);
    return column < 0 ? "" : gdal().OGR_F_GetFieldAsString(this->Feature.get(), column);
  }

  template <typename Take>
  static void forPointsOf(OGRGeometryH geometry, const Take& take)
  {
    const OGRwkbGeometryType kind = gdal().OGR_GT_Flatten(gdal().OGR_G_GetGeometryType(geometry));
    if (kind == wkbPoint && gdal().OGR_G_IsEmpty(geometry) == 0)
    {
      take(gdal().OGR_G_GetX(geometry, 0), gdal().OGR_G_GetY(geometry, 0),
        gdal().OGR_G_Is3D(geometry) != 0 ? gdal().OGR_G_GetZ(geometry, 0) : none);
    }
    if (kind == wkbMultiPoint || kind == wkbGeometryCollection)
    {
      const int parts = gdal().OGR_G_GetGeometryCount(geometry);
      for (int i = 0; i < parts; ++i)
      {
        forPointsOf(gdal().OGR_G_GetGeometryRef(geometry, i), take);
      }
    }
  }

  const std::string Path;
  const std::string LayerName;
  const bool IsDrawing;
  GdalDataSet File;
  int LayerIndex = 0;
  OGRLayerH Layer = nullptr;
  GdalOwner<OGRFeatureH, &GdalLibrary::OGR_F_Destroy> Feature;
  std::map<std::string, int> Columns; ///< indices of the layer's attributes
};

bool isNumber(OGRFieldType type)
{
  return type == OFTInteger || type == OFTInteger64 || type == OFTReal;
}

/// Whether GDAL assumes heights above the ellipsoid because the format names no other: those of
/// most files are not meant so.
bool isWithoutDatumOfHeights(const std::string& path)
{
  const std::string extension = extensionOf(path);
  return extension == ".geojson" || extension == ".json" || extension == ".kml";
}

/// Adds the attributes of a layer that has points, and its reference system. Throws IOError if the
/// layers before are in another one.
void addLayer(OGRLayerH layer, const std::string& path, GisSurvey& survey)
{
  const OGRFeatureDefnH definition = gdal().OGR_L_GetLayerDefn(layer);
  const int fields = gdal().OGR_FD_GetFieldCount(definition);
  for (int i = 0; i < fields; ++i)
  {
    const OGRFieldDefnH field = gdal().OGR_FD_GetFieldDefn(definition, i);
    const std::string name = gdal().OGR_Fld_GetNameRef(field);
    std::vector<std::string>& names = survey.Attributes;
    if (isNumber(gdal().OGR_Fld_GetType(field)) &&
      std::find(names.begin(), names.end(), name) == names.end())
    {
      names.push_back(name);
    }
  }
  const OGRSpatialReferenceH system = gdal().OGR_L_GetSpatialRef(layer);
  if (!system || gdal().OSRIsLocal(system) != 0) // a local one says nothing
  {
    return;
  }
  const GdalReference plain(gdal().OSRClone(system));
  if (isWithoutDatumOfHeights(path))
  {
    gdal().OSRDemoteTo2D(plain.get(), nullptr);
  }
  const std::string text = wktOf(plain.get());
  if (!survey.Crs.Text.empty() && survey.Crs.Text != text)
  {
    throw IOError(
      path, "has layers in different coordinate reference systems; choose one with --layer.");
  }
  survey.Crs.Text = text;
  survey.IsGeographic = gdal().OSRIsGeographic(system) != 0;
}

GisSurvey surveyGis(const std::string& path, const std::string& layer)
{
  constexpr double mostDegrees = 360;
  GisFeatures features(path, layer);
  GisSurvey survey;
  OGRLayerH last = nullptr;
  while (features.next())
  {
    const std::int64_t before = survey.Points;
    features.forPoints(
      [&](double x, double y, double z)
      {
        ++survey.Points;
        survey.Flat += std::isnan(z) ? 1 : 0;
        survey.HasZ = survey.HasZ || !std::isnan(z);
        survey.HasNonzeroZ = survey.HasNonzeroZ || (!std::isnan(z) && z != 0);
        survey.IsBeyondDegrees =
          survey.IsBeyondDegrees || std::fabs(x) > mostDegrees || std::fabs(y) > mostDegrees;
      });
    const bool isText = features.isText();
    survey.Texts += isText ? 1 : 0;
    survey.WithoutPoint += survey.Points == before && !isText ? 1 : 0;
    if (survey.Points > before && features.layer() != last)
    {
      last = features.layer();
      addLayer(last, path, survey);
    }
  }
  return survey;
}

std::string counted(std::int64_t count, const std::string& one, const std::string& many)
{
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

class GisPoints : public FilePoints
{
public:
  GisPoints(const std::string& path, const PointOptions& options)
    : Path(path)
    , Layer(options.Layer)
    , Survey(surveyGis(path, options.Layer))
  {
    if (this->Survey.Points == 0)
    {
      throw IOError(path,
        "has no points" + (this->Layer.empty() ? "" : " in the layer '" + this->Layer + "'") +
          "; lines and polygons can be given as constraints.");
    }
    this->Heights = this->chooseHeights(options.Z);
    const bool hasHeights = this->Survey.HasZ || !this->Heights.empty();
    if (hasHeights && options.wants("z"))
    {
      this->Columns.push_back({ "z", this->Heights, this->Heights.empty() });
    }
    for (const std::string& name : this->Survey.Attributes)
    {
      const bool isTaken = hasHeights && name == "z";
      if (!isTaken && options.wants(name))
      {
        this->Columns.push_back({ name, name, false });
      }
    }
    this->report(hasHeights);
  }

  bool next(PointBlock& block, std::size_t most) override
  {
    if (!this->Features)
    {
      this->Features = std::make_unique<GisFeatures>(this->Path, this->Layer);
    }
    block.Columns.resize(this->Columns.size());
    while (block.size() < most && (this->At < this->Pending.size() || this->load()))
    {
      this->take(block);
    }
    return block.size() > 0;
  }

  void rewind() override
  {
    this->Features.reset(); // there may be many files
    this->Pending.clear();
    this->At = 0;
  }

  std::vector<std::string> columns() const override
  {
    std::vector<std::string> names;
    std::transform(this->Columns.begin(), this->Columns.end(), std::back_inserter(names),
      [](const Column& column) { return column.Name; });
    return names;
  }

  std::int64_t most() const override { return this->Survey.Points; }

  ReferenceSystem referenceSystem() const override
  {
    if (this->Survey.IsGeographic && this->Survey.IsBeyondDegrees)
    {
      ReferenceSystem none;
      none.Problem =
        IOError(this->Path, "states longitudes and latitudes, but has larger numbers").what();
      return none;
    }
    return understandCrs(this->Survey.Crs);
  }

  std::vector<TableReport> reports() const override { return { this->Report }; }

private:
  struct Column
  {
    std::string Name;
    std::string Attribute;
    bool IsGeometry; ///< z of the geometry
  };

  /// Returns the attribute that has the heights; empty if they are z of the geometry, or there are
  /// none.
  std::string chooseHeights(const std::string& asked) const
  {
    const std::vector<std::string>& names = this->Survey.Attributes;
    if (!asked.empty())
    {
      if (std::find(names.begin(), names.end(), asked) == names.end())
      {
        throw IOError(this->Path,
          "has no attribute '" + asked + "' of numbers" +
            listOfNames({ names.begin(), names.end() }, "; there are ") + ".");
      }
      return asked;
    }
    for (const char* const usual : { "z", "elevation", "elev", "height" })
    {
      const auto found = std::find_if(names.begin(), names.end(),
        [usual](const std::string& name) { return lowerCase(name) == usual; });
      if (found != names.end() && !this->Survey.HasZ)
      {
        return *found;
      }
    }
    return "";
  }

  void report(bool hasHeights)
  {
    const GisSurvey& survey = this->Survey;
    this->Report.Path = this->Path;
    this->Report.Columns = !hasHeights ? "points without z"
      : this->Heights.empty()          ? "z from the points"
                                       : "z from the attribute '" + this->Heights + "'";
    std::vector<std::string>& warnings = this->Report.Warnings;
    if (survey.WithoutPoint > 0)
    {
      warnings.push_back(
        counted(survey.WithoutPoint, "feature has", "features have") + " no point; left out.");
    }
    if (survey.Texts > 0)
    {
      this->Report.Remarks.push_back(counted(survey.Texts, "text is", "texts are") + " left out.");
    }
    if (survey.HasZ && this->Heights.empty() && survey.Flat > 0)
    {
      warnings.push_back(counted(survey.Flat, "point has", "points have") + " no z.");
    }
    if (survey.HasZ && !survey.HasNonzeroZ && this->Heights.empty())
    {
      warnings.emplace_back(
        "z of all points is 0; if an attribute has the heights, name it with --z.");
    }
  }

  /// Loads the points of the next feature.
  bool load()
  {
    this->Pending.clear();
    this->At = 0;
    while (this->Pending.empty() && this->Features->next())
    {
      this->Features->forPoints(
        [this](double x, double y, double z) {
          this->Pending.push_back({ x, y, z });
        });
    }
    this->Values.clear();
    for (const Column& column : this->Columns)
    {
      this->Values.push_back(this->Pending.empty() || column.IsGeometry
          ? none
          : this->Features->attribute(column.Attribute));
    }
    return !this->Pending.empty();
  }

  /// Appends the next point of the feature.
  void take(PointBlock& block)
  {
    const Point3& point = this->Pending[this->At++];
    block.XY.insert(block.XY.end(), { point.x, point.y });
    for (std::size_t i = 0; i < this->Columns.size(); ++i)
    {
      block.Columns[i].push_back(this->Columns[i].IsGeometry ? point.z : this->Values[i]);
    }
  }

  const std::string Path;
  const std::string Layer;
  const GisSurvey Survey;
  std::string Heights; ///< the attribute that is z; empty: that of the geometry
  std::vector<Column> Columns;
  TableReport Report;
  std::unique_ptr<GisFeatures> Features;
  std::vector<Point3> Pending; ///< the points of the current feature
  std::size_t At = 0;          ///< the next of them
  std::vector<double> Values;  ///< the attributes of the current feature
};

} // namespace

std::unique_ptr<FilePoints> openGisPoints(const std::string& path, const PointOptions& options)
{
  return std::make_unique<GisPoints>(path, options);
}

#else

std::unique_ptr<FilePoints> openGisPoints(const std::string& path, const PointOptions&)
{
  throw IOError(path,
    "needs GDAL, and this tipp was built without it; read it with geopandas and give tipp the "
    "coordinates, or build tipp with libgdal-dev.");
}

#endif

} // namespace tipp
