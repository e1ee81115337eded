// SPDX-License-Identifier: BSD-3-Clause
#include "Refinement/ReadSizes.h"

#include "Files/IOError.h"
#include "Files/TextFile.h"
#include "Predicates/SensibleRange.h"
#include "Refinement/PlaneValues.h"
#include "Refinement/SizeRules.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <utility>

namespace tipp
{
namespace
{

constexpr double infinite = std::numeric_limits<double>::infinity();

[[noreturn]] void refuse(const std::string& sentence)
{
  throw std::invalid_argument(sentence);
}

/// The number that Size is; nullopt if it is a path or not given.
std::optional<double> numberOf(const SizeArguments& arguments)
{
  return wholeNumber<double>(arguments.Size);
}

bool isFile(const SizeArguments& arguments)
{
  return !arguments.Size.empty() && !numberOf(arguments);
}

void requirePositive(const char* name, const std::optional<double>& value)
{
  if (value && !(*value > 0 && std::isfinite(*value)))
  {
    refuse(std::string(name) + " is " + shortText(*value) + "; give a number above 0.");
  }
}

void requireNumbers(const SizeArguments& arguments)
{
  requirePositive("The size", numberOf(arguments));
  requirePositive("The factor of the distance (dis)", arguments.Dis);
  requirePositive("The number of elements in a wavelength (wl)", arguments.WaveLength);
  requirePositive("The parameter of the slope (slp)", arguments.Slope);
  requirePositive("The least size", arguments.Least);
  requirePositive("The largest size", arguments.Largest);
  requirePositive("The gradation (g)", arguments.Gradation);
  if (arguments.Least && arguments.Largest && *arguments.Least > *arguments.Largest)
  {
    refuse("The least size, " + shortText(*arguments.Least) + ", is above the largest, " +
      shortText(*arguments.Largest) + "; give a smaller one.");
  }
  constexpr std::int64_t fewest = 16;
  constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max();
  if (arguments.MostNodes < fewest || arguments.MostNodes > most)
  {
    refuse("The number of nodes of the size function is " + std::to_string(arguments.MostNodes) +
      "; give one from " + std::to_string(fewest) + " to " + std::to_string(most) + ".");
  }
}

/// Requires what the rules need, and that nothing is given in vain.
void requireComplete(const SizeArguments& arguments, bool hasShoreline)
{
  const bool needsDepth = arguments.WaveLength || arguments.Slope;
  if (arguments.Size.empty() && !arguments.Dis && !needsDepth)
  {
    refuse("No size is given; give a number, a file with sizes, or a rule: the distance to the "
           "shoreline (dis), the wavelength (wl) or the slope (slp).");
  }
  if (needsDepth && arguments.Depth.empty())
  {
    refuse("The wavelength (wl) and the slope (slp) need depths; give a file with them.");
  }
  if (arguments.Dis && !arguments.Least)
  {
    refuse("The distance to the shoreline (dis) needs the size there; give the least size.");
  }
  if (arguments.Dis && !hasShoreline)
  {
    refuse("The distance to the shoreline (dis) needs lines, but the input has none; give some.");
  }
  if (arguments.Slope && (!arguments.Least || !arguments.Largest))
  {
    refuse("The slope (slp) gives no size to a level or a vertical bottom; give the least and the "
           "largest size.");
  }
  if (!needsDepth && !arguments.Depth.empty())
  {
    refuse("Depths have no effect without the wavelength (wl) or the slope (slp); give one of "
           "these.");
  }
  if (arguments.Depth.empty() && (arguments.DepthIsElevation || !arguments.DepthColumn.empty()))
  {
    refuse("No file with depths is given that its column or sign could be of; give one.");
  }
  if (!isFile(arguments) && !arguments.Column.empty())
  {
    refuse("No file with sizes is given that '" + arguments.Column +
      "' could be a column of; give one.");
  }
}

/// Opens a file and requires that it lies in the domain.
std::unique_ptr<PlaneValues> openWithin(
  const std::string& path, const PlaneValuesOptions& options, const Box2& domain)
{
  if (!isFinite(domain))
  {
    refuse("The domain has no finite corners, so nothing can be read there; give lines with finite "
           "coordinates.");
  }
  std::unique_ptr<PlaneValues> values = openPlaneValues(path, options);
  if (!values->box().meets(domain))
  {
    throw IOError(path,
      "lies at " + inWords(inSpace(values->box())) + ", but the domain at " +
        inWords(inSpace(domain)) +
        "; give a file of the same place, in the same reference system.");
  }
  return values;
}

/// The size function of a domain while it is made.
class SizeMaker
{
public:
  SizeMaker(const SizeArguments& arguments, const Box2& domain, int threads, const Report& report)
    : Arguments(arguments)
    , Domain(domain)
    , Threads(threads)
    , Progress(report)
    , Number(numberOf(arguments))
    , Bottom(arguments.Least.value_or(0))
    , Top(arguments.Largest.value_or(infinite))
  {
  }

  SizeFunction make(const std::vector<std::array<Point2, 2>>& shoreline)
  {
    this->openFiles();
    const bool isConstant = this->Number && !this->Sizes && !this->Arguments.Dis && !this->Depths;
    if (isConstant && !this->Arguments.Geographic)
    {
      return SizeFunction(std::clamp(*this->Number, this->Bottom, this->Top));
    }
    const SizeLattice lattice(this->Domain, this->spacing(isConstant), this->Arguments.MostNodes,
      this->Arguments.Geographic ? PlaneKind::Geographic : PlaneKind::Projected);
    std::vector<double> sizes(
      lattice.nodes(), std::min(this->Number.value_or(infinite), this->Top));
    this->takeFile(lattice, sizes);
    this->takeDepths(lattice, sizes);
    if (this->Arguments.Dis)
    {
      limitByDistance(lattice, shoreline, *this->Arguments.Least, *this->Arguments.Dis,
        this->Threads, partOf(this->Progress, 0.7, 0.9), sizes);
    }
    for (double& size : sizes)
    {
      size = std::max(size, this->Bottom);
    }
    if (this->Arguments.Gradation)
    {
      limitGradation(lattice, *this->Arguments.Gradation, partOf(this->Progress, 0.9, 1), sizes);
    }
    return SizeFunction(lattice, std::move(sizes));
  }

private:
  void openFiles()
  {
    PlaneValuesOptions options;
    options.RasterBounds = this->Arguments.RasterBounds;
    options.Threads = this->Threads;
    if (isFile(this->Arguments))
    {
      options.Column = this->Arguments.Column;
      options.Names = { "size" };
      this->Sizes = openWithin(this->Arguments.Size, options, this->Domain);
    }
    if (!this->Arguments.Depth.empty())
    {
      options.Column = this->Arguments.DepthColumn;
      options.Names = this->Arguments.DepthIsElevation
        ? std::vector<std::string>{ "z", "Z", "elevation" }
        : std::vector<std::string>{ "depth" };
      this->Depths = openWithin(this->Arguments.Depth, options, this->Domain);
    }
  }

  /// Returns the distance of nodes that the least size asks for.
  double spacing(bool isConstant)
  {
    double least = std::min(this->Number.value_or(infinite), this->Top);
    if (this->Sizes)
    {
      const double given = this->Sizes->least(this->Domain, partOf(this->Progress, 0, 0.1));
      if (!(given > 0))
      {
        throw IOError(
          this->Arguments.Size, "has the size " + shortText(given) + "; sizes must be above 0.");
      }
      least = std::min(least, given);
    }
    if (this->Arguments.WaveLength)
    {
      least = std::min(least, sizeByWavelength(LeastDepth, *this->Arguments.WaveLength));
    }
    least = this->Arguments.Least.value_or(least);
    // In degrees, a constant size changes only with the latitude, smoothly.
    constexpr double mostRows = 1024;
    const double height = this->Domain.width(1) * SizeLattice::MetresPerDegree;
    return isConstant ? std::max(least / 2, height / mostRows) : least / 2;
  }

  void takeFile(const SizeLattice& lattice, std::vector<double>& sizes)
  {
    if (this->Sizes)
    {
      const std::vector<double> given =
        this->Sizes->sample(lattice, this->Threads, partOf(this->Progress, 0.1, 0.3));
      std::transform(sizes.begin(), sizes.end(), given.begin(), sizes.begin(),
        [](double size, double other) { return std::min(size, other); });
      this->Sizes.reset();
    }
  }

  void takeDepths(const SizeLattice& lattice, std::vector<double>& sizes)
  {
    if (!this->Depths)
    {
      return;
    }
    std::vector<double> depths =
      this->Depths->sample(lattice, this->Threads, partOf(this->Progress, 0.3, 0.6));
    this->Depths.reset();
    if (this->Arguments.DepthIsElevation)
    {
      std::transform(depths.begin(), depths.end(), depths.begin(), [](double z) { return -z; });
    }
    if (this->Arguments.WaveLength)
    {
      limitByWavelength(lattice, depths, *this->Arguments.WaveLength, this->Threads,
        partOf(this->Progress, 0.6, 0.65), sizes);
    }
    if (this->Arguments.Slope)
    {
      limitBySlope(lattice, depths, *this->Arguments.Slope, this->Threads,
        partOf(this->Progress, 0.65, 0.7), sizes);
    }
  }

  const SizeArguments& Arguments;
  Box2 Domain;
  int Threads;
  const Report& Progress;
  std::optional<double> Number; ///< the size everywhere, if it is given as a number
  double Bottom;                ///< the least size; 0: none is given
  double Top;                   ///< the largest size; infinite: none is given
  std::unique_ptr<PlaneValues> Sizes;
  std::unique_ptr<PlaneValues> Depths;
};

} // namespace

SizeFunction makeSizeFunction(const SizeArguments& arguments,
  const std::vector<std::array<Point2, 2>>& shoreline, const Box2& domain, int threads,
  const Report& report)
{
  requireNumbers(arguments);
  requireComplete(arguments, !shoreline.empty());
  return SizeMaker(arguments, domain, threads, report).make(shoreline);
}

} // namespace tipp
