# SPDX-License-Identifier: BSD-3-Clause
"""The plugin must load without a warning, and its proxies have the properties of the proxies that they replace."""
from run_paraview import Session, expect

PROGRAM = """
import os
from paraview import servermanager
from paraview.simple import *
LoadPlugin(os.path.join(os.environ["TIPP_PLUGIN_DIR"], "TIPPPlugin.so"), remote=False, ns=globals())

def properties(proxy):
    return set(proxy.ListProperties())

points = Plane(XResolution=20, YResolution=10)
ours, theirs = TIPPDelaunay2D(Input=points), Delaunay2D(Input=points)
print("missing of Delaunay2D:", sorted(properties(theirs) - properties(ours)))
ours.UpdatePipeline()
print("triangles:", ours.GetDataInformation().GetNumberOfCells())
print("statistics:", OutputPort(ours, 1).GetDataInformation().GetDataClassName())

diagonal = Line(Point1=(-0.5, -0.5, 0), Point2=(0.5, 0.5, 0), Resolution=1)
constrained = TIPPDelaunay2D(Input=points, Source=diagonal, ConstraintMarks="Lines")
constrained.UpdatePipeline()
print("with lines:", constrained.GetDataInformation().GetNumberOfCells())

ours, theirs = RangeResample(Input=ours), ResampleToImage(Input=points)
print("missing of ResampleToImage:", sorted(properties(theirs) - properties(ours)))
print("devices:", ours.GetProperty("Device").GetAvailable()[:2])
ours.UpdatePipeline()
print("samples:", ours.GetDataInformation().GetExtent())

means = RangeResample(Input=Elevation(Input=points, LowPoint=(-0.5, 0, 0), HighPoint=(0.5, 0, 0)),
                      SamplingDimensions=[5, 5, 1], Method="Conservative", PassCoveredShare=1)
means.UpdatePipeline()
shares = means.PointData["CoveredShare"]
print("means:", shares.GetRange(), [round(limit, 6) for limit in means.PointData["Elevation"].GetRange()])

remapped = TIPPRemap(Input=Plane(XResolution=2, YResolution=2), Source=Elevation(Input=points, LowPoint=(-0.5, 0, 0),
                                                                                 HighPoint=(0.5, 0, 0)))
remapped.UpdatePipeline()
print("remapped:", remapped.CellData["CoveredShare"].GetRange(),
      [round(limit, 6) for limit in remapped.CellData["Elevation"].GetRange()])

volumes = TIPPCutFill(Input=Plane(), Source=Plane(Origin=(-0.5, -0.5, 2), Point1=(0.5, -0.5, 2), Point2=(-0.5, 0.5, 2)))
row = servermanager.Fetch(volumes)
print("volumes:", {name: row.GetColumnByName(name).GetValue(0) for name in ("Cut", "Fill", "Area")})

raster = TIPPPointsToImage(Input=Plane(XResolution=10, YResolution=10), Resolution=0.1, Bands=["elevation", "slope"])
raster.UpdatePipeline()
print("raster:", raster.GetDataInformation().GetExtent(), sorted(raster.PointData.keys()))

meshed = TIPPRefine2D(Input=Plane(), MaximumArea=0.01, Regions=[0, 0, 0.001])
meshed.UpdatePipeline()
print("meshed:", sorted(meshed.CellData.keys()))

asked = Plane(XResolution=3, YResolution=3, Origin=(-0.4, -0.4, 0), Point1=(0.4, -0.4, 0), Point2=(-0.4, 0.9, 0))
sampled = TIPPMeshQuery(Input=asked, Source=Elevation(Input=points, LowPoint=(-0.5, 0, 0), HighPoint=(0.5, 0, 0)))
sampled.UpdatePipeline()
print("queried:", sorted(sampled.PointData.keys()), sampled.PointData["vtkValidPointMask"].GetRange())

from tipp import vtkTIPPDelaunay2D, vtkTIPPRangeReader
print("wrapped:", vtkTIPPDelaunay2D().GetClassName(), vtkTIPPRangeReader().GetUseRange())

definitions = servermanager.ProxyManager().SMProxyManager.GetProxyDefinitionManager()
for group, name in (("sources", "TIPPReader"), ("writers", "TIPPWriter"), ("filters", "TIPPDelaunay2D"),
                    ("sources", "TIPPOutOfCoreDelaunay2D"), ("filters", "RangeResample"), ("filters", "TIPPPointsToImage"),
                    ("filters", "TIPPRefine2D"), ("filters", "TIPPRemap"), ("filters", "TIPPCutFill"),
                    ("filters", "TIPPMeshQuery")):
    proxy = servermanager.ProxyManager().NewProxy(group, name)
    names = servermanager.PropertyIterator(servermanager._getPyProxy(proxy))
    bare = [p.GetXMLName() for p in names if not (p.GetDocumentation() and p.GetDocumentation().GetDescription())]
    print("undocumented of", name + ":", bare)
    # The window has no widget for these.
    names = servermanager.PropertyIterator(servermanager._getPyProxy(proxy))
    print("unseen of", name + ":", [p.GetXMLName() for p in names if p.IsA("vtkSMIdTypeVectorProperty")])
"""
EXPECTED = [
    "missing of Delaunay2D: []",
    "triangles: 400",
    "statistics: vtkTable",
    "with lines: 410",
    "missing of ResampleToImage: []",
    "devices: ['auto', 'openmp']",
    "samples: (0, 255, 0, 255, 0, 0)",
    "remapped: (1.0, 1.0) [0.25, 0.75]",
    "volumes: {'Cut': 0.0, 'Fill': 2.0, 'Area': 1.0}",
    "means: (0.25, 1.0) [0.0625, 0.9375]",
    "wrapped: vtkTIPPDelaunay2D False",
    "undocumented of TIPPReader: []",
    "unseen of TIPPReader: []",
    "undocumented of TIPPWriter: []",
    "unseen of TIPPWriter: []",
    "undocumented of TIPPDelaunay2D: []",
    "unseen of TIPPDelaunay2D: []",
    "undocumented of TIPPOutOfCoreDelaunay2D: []",
    "unseen of TIPPOutOfCoreDelaunay2D: []",
    "undocumented of RangeResample: []",
    "unseen of RangeResample: []",
    "undocumented of TIPPPointsToImage: []",
    "unseen of TIPPPointsToImage: []",
    "undocumented of TIPPRefine2D: []",
    "unseen of TIPPRefine2D: []",
    "undocumented of TIPPRemap: []",
    "unseen of TIPPRemap: []",
    "undocumented of TIPPCutFill: []",
    "unseen of TIPPCutFill: []",
    "undocumented of TIPPMeshQuery: []",
    "unseen of TIPPMeshQuery: []",
    "queried: ['CellId', 'Elevation', 'Normals', 'TextureCoordinates', 'elevation', 'vtkValidPointMask'] (0.0, 1.0)",
    "meshed: ['OutsideBounds', 'Region']",
    "raster: (0, 9, 0, 9, 0, 0) ['elevation', 'slope']",
]

session = Session(__doc__)
script = session.scratch / "plugin.py"
script.write_text(PROGRAM)
lines = session.pvbatch(script).splitlines()
for line in EXPECTED:
    expect(line in lines, f"not printed: {line}")
