// SPDX-License-Identifier: BSD-3-Clause
#include "Files/MeshDescription.h"

#include "Files/IOError.h"
#include "Files/TextFile.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

namespace tipp
{
namespace
{

using Json = nlohmann::ordered_json;

bool isControl(char c)
{
  const auto byte = static_cast<unsigned char>(c);
  return (byte < 0x20 && c != '\t' && c != '\n' && c != '\r') || byte == 0x7f;
}

std::string validText(const std::string& text)
{
  std::string valid = utf8Of(text);
  std::replace_if(valid.begin(), valid.end(), isControl, ' ');
  return valid;
}

void addText(Json& object, const char* key, const std::string& text)
{
  if (!text.empty())
  {
    object[key] = validText(text);
  }
}

Json pack(const std::map<std::string, ArrayDescription>& arrays)
{
  Json object = Json::object();
  for (const auto& [name, array] : arrays)
  {
    Json& packed = object[name] = Json::object();
    addText(packed, "long_name", array.LongName);
    addText(packed, "standard_name", array.StandardName);
    addText(packed, "units", array.Units);
    if (array.Missing)
    {
      packed["missing_value"] = *array.Missing;
    }
    for (const std::string& component : array.Components)
    {
      packed["components"].push_back(validText(component));
    }
  }
  return object;
}

/// Reads a description; each error names the key.
class DescriptionReader
{
public:
  explicit DescriptionReader(const std::string& path)
    : Path(path)
  {
  }

  MeshDescription read(const Json& json) const
  {
    this->require(json.is_object(), "is no object of JSON");
    MeshDescription description;
    description.TimeUnits = this->text(json, "time_units");
    description.Calendar = this->text(json, "calendar");
    description.Crs = this->text(json, "crs");
    this->require(description.Crs.empty() || isCrsText(description.Crs),
      "has a 'crs' that is neither WKT, PROJJSON, a text for PROJ nor a code such as EPSG:4326");
    description.PointData = this->arrays(json, "point_data");
    description.CellData = this->arrays(json, "cell_data");
    return description;
  }

  void require(bool holds, const std::string& problem) const
  {
    if (!holds)
    {
      throw IOError(
        this->Path, "describes the mesh, but " + problem + "; correct it or write the mesh again.");
    }
  }

private:
  std::string text(const Json& object, const char* key) const
  {
    const auto found = object.find(key);
    return found == object.end() ? "" : this->textOf(*found, key);
  }

  std::string textOf(const Json& value, const char* key) const
  {
    this->require(value.is_string(), std::string("its '") + key + "' is no text");
    std::string text = value.get<std::string>();
    this->require(std::none_of(text.begin(), text.end(), isControl),
      std::string("its '") + key + "' has control characters");
    return text;
  }

  std::vector<std::string> texts(const Json& object, const char* key) const
  {
    std::vector<std::string> texts;
    const auto found = object.find(key);
    if (found != object.end())
    {
      this->require(found->is_array(), std::string("its '") + key + "' is no list");
      for (const Json& value : *found)
      {
        texts.push_back(this->textOf(value, key));
        this->require(!texts.back().empty(), std::string("its '") + key + "' has an empty text");
      }
    }
    return texts;
  }

  ArrayDescription array(const Json& object, const std::string& name) const
  {
    this->require(object.is_object(), "what it says of '" + shownText(name) + "' is no object");
    ArrayDescription array;
    array.LongName = this->text(object, "long_name");
    array.StandardName = this->text(object, "standard_name");
    array.Units = this->text(object, "units");
    const auto missing = object.find("missing_value");
    if (missing != object.end())
    {
      this->require(missing->is_number() && std::isfinite(missing->get<double>()),
        "the 'missing_value' of '" + shownText(name) + "' is no finite number");
      array.Missing = missing->get<double>();
    }
    array.Components = this->texts(object, "components");
    return array;
  }

  std::map<std::string, ArrayDescription> arrays(const Json& json, const char* key) const
  {
    std::map<std::string, ArrayDescription> arrays;
    const auto found = json.find(key);
    if (found != json.end())
    {
      this->require(found->is_object(), std::string("its '") + key + "' is no object");
      for (const auto& [name, object] : found->items())
      {
        arrays[name] = this->array(object, name);
      }
    }
    return arrays;
  }

  const std::string& Path;
};

/// The end of the blanks and letters from a position on.
std::size_t endOfWord(const std::string& text, std::size_t at)
{
  while (
    at < text.size() && (std::isalpha(static_cast<unsigned char>(text[at])) || text[at] == '_'))
  {
    ++at;
  }
  return std::min(text.find_first_not_of(" \t\r\n", at), text.size());
}

} // namespace

std::string ArrayDescription::nameOf(const std::string& array, int component, int components) const
{
  const bool areNamed = this->Components.size() == std::size_t(components);
  return components == 1 ? array
    : areNamed           ? this->Components[std::size_t(component)]
                         : array + "_" + std::to_string(component);
}

bool MeshDescription::isEmpty() const
{
  return this->TimeUnits.empty() && this->Calendar.empty() && this->Crs.empty() &&
    this->PointData.empty() && this->CellData.empty();
}

ArrayDescription MeshDescription::arrayOf(const std::string& name, bool onCells) const
{
  const auto& arrays = onCells ? this->CellData : this->PointData;
  const auto found = arrays.find(utf8Of(name));
  return found == arrays.end() ? ArrayDescription() : found->second;
}

void MeshDescription::add(const std::string& name, bool onCells, const ArrayDescription& array)
{
  if (!array.isEmpty())
  {
    (onCells ? this->CellData : this->PointData)[utf8Of(name)] = array;
  }
}

std::string descriptionText(const MeshDescription& description, bool isIndented)
{
  Json json = Json::object();
  addText(json, "time_units", description.TimeUnits);
  addText(json, "calendar", description.Calendar);
  addText(json, "crs", description.Crs);
  if (!description.PointData.empty())
  {
    json["point_data"] = pack(description.PointData);
  }
  if (!description.CellData.empty())
  {
    json["cell_data"] = pack(description.CellData);
  }
  return json.dump(isIndented ? 2 : -1, ' ', false, Json::error_handler_t::replace);
}

MeshDescription parseDescription(const std::string& text, const std::string& path)
{
  const DescriptionReader reader(path);
  const Json json = Json::parse(text, nullptr, false);
  reader.require(!json.is_discarded(), "is not JSON");
  return reader.read(json);
}

bool isCrsText(const std::string& text)
{
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string::npos)
  {
    return false;
  }
  const std::size_t end = endOfWord(text, first);
  const bool isWkt = end > first && end < text.size() && (text[end] == '[' || text[end] == '(');
  const auto isOfName = [](char c)
  {
    return std::isalnum(static_cast<unsigned char>(c)) ||
      std::string(":+_- ").find(c) != std::string::npos;
  };
  return isWkt || text[first] == '{' || text[first] == '+' ||
    std::all_of(text.begin(), text.end(), isOfName);
}

} // namespace tipp
