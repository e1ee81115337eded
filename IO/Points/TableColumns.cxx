// SPDX-License-Identifier: BSD-3-Clause
// The names that columns of coordinates have: the one table for all readers, the tool and Python.
#include "Points/TableColumns.h"

#include "Files/IOError.h"
#include "Files/TextFile.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace tipp
{
namespace
{

using Names = std::vector<std::string>;

/// Names of x and y, from the most to the least preferred.
constexpr std::array<std::pair<std::string_view, std::string_view>, 33> pairs = { { { "x", "y" },
  { "easting", "northing" }, { "eastings", "northings" }, { "east", "north" }, { "e", "n" },
  { "pointx", "pointy" }, { "xcoord", "ycoord" }, { "xcoordinate", "ycoordinate" },
  { "coordx", "coordy" }, { "coordinatex", "coordinatey" }, { "points0", "points1" },
  { "rechtswert", "hochwert" }, { "rechts", "hoch" }, { "ostwert", "nordwert" }, { "ost", "nord" },
  { "est", "nord" }, { "este", "norte" }, { "rw", "hw" }, { "xkoordinate", "ykoordinate" },
  { "xwert", "ywert" }, { "posx", "posy" }, { "utme", "utmn" }, { "lon", "lat" }, { "lng", "lat" },
  { "long", "lat" }, { "longitude", "latitude" }, { "decimallongitude", "decimallatitude" },
  { "lond", "latd" }, { "longitud", "latitud" }, { "laengengrad", "breitengrad" },
  { "l\xc3\xa4ngengrad", "breitengrad" }, { "laenge", "breite" }, { "lambda", "phi" } } };

/// Names of heights, from the most to the least preferred.
constexpr std::array<std::string_view, 37> heights = { "z", "elevation", "elev",
  "orthometricheight", "orthoheight", "orthoht", "altitude", "alt", "height", "hoehe",
  "h\xc3\xb6he", "ellipsoidalheight", "ellipsoidheight", "ellheight", "h", "ht", "hgt", "rl",
  "cota", "quota", "altitud", "altezza", "hauteur", "zcoord", "zcoordinate", "zkoordinate", "zwert",
  "coordz", "coordinatez", "pointz", "posz", "points2", "groundelevation", "surfaceelevation",
  "gridcode", "rastervalu", "rastervalue" };

constexpr std::array<std::string_view, 6> depths = { "depth", "waterdepth", "tiefe", "wassertiefe",
  "profondeur", "profundidad" };

constexpr std::array<std::string_view, 31> ids = { "id", "fid", "oid", "gid", "uid", "pid",
  "objectid", "ogcfid", "point", "pointid", "pointno", "pointnr", "pointnumber", "pt", "ptid",
  "ptno", "ptnr", "no", "nr", "num", "number", "nummer", "index", "idx", "row", "rownames",
  "station", "punkt", "punktnr", "punktnummer", "unnamed0" };

constexpr std::array<std::string_view, 22> texts = { "remark", "remarks", "code", "codes", "desc",
  "description", "descriptor", "comment", "comments", "note", "notes", "name", "pointname", "label",
  "feature", "featurecode", "type", "layer", "bemerkung", "punktname", "text", "class" };

/// Words that may stand before or after a name, separated from it: POINT_X, "Easting (m)", lat_dd.
constexpr std::array<std::string_view, 14> prefixes = { "point", "rd", "utm", "coord", "centroid",
  "center", "gps", "geo", "grid", "map", "world", "lv95", "gk", "pos" };
constexpr std::array<std::string_view, 18> suffixes = { "m", "ft", "usft", "feet", "metre",
  "metres", "meter", "meters", "dd", "deg", "degree", "degrees", "coord", "coordinate", "wgs84",
  "utm", "etrs89", "rd" };

template <typename List>
bool contains(const List& list, std::string_view word)
{
  return std::find(list.begin(), list.end(), word) != list.end();
}

/// The words of a name in lower case, without a unit in brackets.
Names wordsOf(const std::string& name)
{
  constexpr const char* separators = " \t_-.:";
  const std::string lower = lowerCase(name.substr(0, name.find_first_of("([{")));
  Names words;
  for (std::size_t at = lower.find_first_not_of(separators); at != std::string::npos;)
  {
    const std::size_t end = std::min(lower.find_first_of(separators, at), lower.size());
    words.push_back(lower.substr(at, end - at));
    at = lower.find_first_not_of(separators, end);
  }
  return words;
}

std::string joined(const Names& words)
{
  std::string text;
  for (const std::string& word : words)
  {
    text += word;
  }
  return text;
}

/// The name without case, separators, units and prefixes: "POINT_X" is x. A name that is known as a
/// whole keeps its prefix.
std::string plainName(const std::string& name)
{
  Names words = wordsOf(name);
  while (words.size() > 1 && contains(suffixes, words.back()))
  {
    words.pop_back();
  }
  const bool isIndex = words.size() == 2 && (words[1] == "id" || words[1] == "no");
  while (words.size() > 1 && !isIndex && contains(prefixes, words.front()) &&
    !contains(ids, joined(words)) && !contains(texts, joined(words)) && words[1] != "code")
  {
    words.erase(words.begin());
  }
  return joined(words);
}

/// The columns whose names are those of one way of reading names.
class NameIndex
{
public:
  NameIndex(const Names& given, std::string (*read)(const std::string&))
    : Given(given)
  {
    for (const std::string& name : given)
    {
      this->Read.push_back(read(name));
    }
  }

  /// The column with this name; nullopt: none. Throws std::invalid_argument if there are several.
  std::optional<std::size_t> find(std::string_view name) const
  {
    std::optional<std::size_t> found;
    for (std::size_t i = 0; i < this->Read.size(); ++i)
    {
      if (this->Read[i] == name && found)
      {
        throw std::invalid_argument("has two columns that may be " + std::string(name) + ", '" +
          this->Given[*found] + "' and '" + this->Given[i] + "'");
      }
      found = this->Read[i] == name ? i : found;
    }
    return found;
  }

  bool has(std::string_view name) const { return contains(this->Read, name); }

  /// The first of the names that a column has.
  template <typename List>
  std::optional<std::size_t> findFirst(const List& list) const
  {
    for (const std::string_view name : list)
    {
      if (this->has(name))
      {
        return this->find(name);
      }
    }
    return std::nullopt;
  }

  std::optional<ColumnChoice> findPair() const
  {
    for (const auto& [x, y] : pairs)
    {
      if (this->has(x) && this->has(y))
      {
        return ColumnChoice{ *this->find(x), *this->find(y) };
      }
    }
    return std::nullopt;
  }

  /// x and y of different pairs, as in "x, northing", if there is one of each. Single letters but x
  /// and y have too many other meanings.
  std::optional<ColumnChoice> findMixed() const
  {
    std::set<std::string_view> xs;
    std::set<std::string_view> ys;
    for (const auto& [x, y] : pairs)
    {
      if ((x.size() > 1 || x == "x") && this->has(x))
      {
        xs.insert(x);
      }
      if ((y.size() > 1 || y == "y") && this->has(y))
      {
        ys.insert(y);
      }
    }
    return xs.size() == 1 && ys.size() == 1
      ? std::make_optional(ColumnChoice{ *this->find(*xs.begin()), *this->find(*ys.begin()) })
      : std::nullopt;
  }

private:
  const Names& Given;
  Names Read;
};

std::string wholeName(const std::string& name)
{
  return lowerCase(name);
}

void findZ(const NameIndex& whole, const NameIndex& plain, ColumnChoice& choice)
{
  choice.Z = whole.findFirst(heights);
  choice.Z = choice.Z ? choice.Z : plain.findFirst(heights);
  if (!choice.Z)
  {
    choice.Z = plain.findFirst(depths);
    choice.IsDepth = choice.Z.has_value();
  }
}

} // namespace

ColumnRole columnRole(const std::string& name)
{
  const std::string plain = plainName(name);
  for (const auto& [x, y] : pairs)
  {
    if (plain == x || plain == y)
    {
      return plain == x ? ColumnRole::X : ColumnRole::Y;
    }
  }
  return contains(heights, plain) || contains(depths, plain) ? ColumnRole::Z
    : contains(ids, plain) || contains(texts, plain)         ? ColumnRole::Id
                                                             : ColumnRole::None;
}

bool isOneName(const std::string& first, const std::string& second)
{
  constexpr std::array<std::string_view, 8> ends = { "no", "nr", "id", "num", "number", "nummer",
    "name", "code" };
  const std::string both = lowerCase(first + second);
  const std::string end = lowerCase(second);
  return contains(suffixes, end) ||
    (contains(ends, end) && (contains(ids, both) || contains(texts, both)));
}

bool isTextColumn(const std::string& name)
{
  return contains(texts, plainName(name));
}

void findHeights(const std::vector<std::string>& names, ColumnChoice& choice)
{
  findZ(NameIndex(names, wholeName), NameIndex(names, plainName), choice);
}

std::optional<ColumnChoice> findCoordinates(const std::vector<std::string>& names)
{
  const NameIndex whole(names, wholeName);
  const NameIndex plain(names, plainName);
  std::optional<ColumnChoice> choice = whole.findPair();
  choice = choice ? choice : plain.findPair();
  choice = choice ? choice : plain.findMixed();
  if (choice)
  {
    findZ(whole, plain, *choice);
  }
  return choice;
}

ColumnChoice requireCoordinates(const std::vector<std::string>& names)
{
  if (const auto found = findCoordinates(names))
  {
    return *found;
  }
  const bool areTwo = names.size() == 2 &&
    std::none_of(names.begin(), names.end(),
      [](const std::string& name) { return name.empty() || columnRole(name) != ColumnRole::None; });
  if (areTwo)
  {
    return {};
  }
  throw std::invalid_argument(
    "has the columns " + listOf(names) + ", and their names do not tell x and y");
}

std::string listOf(const std::vector<std::string>& names)
{
  constexpr std::size_t most = 20;
  std::string list;
  for (std::size_t i = 0; i < std::min(most, names.size()); ++i)
  {
    list += (i == 0 ? "" : ", ") + (names[i].empty() ? "''" : shownText(names[i]));
  }
  return list +
    (names.size() > most ? " and " + std::to_string(names.size() - most) + " more" : "");
}

std::vector<std::string> makeDifferent(std::vector<std::string>& names)
{
  std::set<std::string> all(names.begin(), names.end());
  std::map<std::string, std::int64_t> seen; ///< how often each name has been met
  std::vector<std::string> changed;
  for (std::string& name : names)
  {
    std::int64_t& count = seen[name];
    if (++count == 1)
    {
      continue;
    }
    changed.push_back(name);
    std::string other = name + "_" + std::to_string(count);
    while (!all.insert(other).second)
    {
      other = name + "_" + std::to_string(++count);
    }
    name = std::move(other);
  }
  return changed;
}

} // namespace tipp
