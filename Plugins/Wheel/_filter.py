# SPDX-License-Identifier: BSD-3-Clause
"""The base class of the wheel's VTK filters: properties, lists of texts, selections of arrays, errors."""
from __future__ import annotations

import warnings
from typing import Any, Callable

from ._arguments import STOPPED
from ._vtkmodules import (
    VTKPythonAlgorithmBase,
    vtkAlgorithm,
    vtkDataArraySelection,
    vtkDataObject,
    vtkDoubleArray,
    vtkIdTypeArray,
    vtkOutputWindow,
)


class Filter(VTKPythonAlgorithmBase):
    """A filter with methods Set... and Get... for each of its PROPERTIES; flags also have ...On and ...Off."""

    PROPERTIES: dict[str, Any] = {}
    """Names of properties, and their defaults."""
    LIMITS: dict[str, tuple[Any, Any]] = {}
    """The smallest and largest values of properties. Values beyond them are clamped, as in VTK."""
    INPUTS: tuple[str, ...] = ()
    OPTIONAL_INPUTS: tuple[int, ...] = ()
    INPUT_NAMES: dict[str, int] = {}
    """Names of inputs, such as Source, and their ports. They have methods Set...Data, Set...Connection and Get...."""
    OUTPUTS: tuple[str, ...] = ()
    LIST = ""
    """The name, in methods, of an item of the filter's list of texts, such as file names. Empty: no list."""
    SELECTIONS = False
    """Whether the filter has selections of arrays."""

    def __init_subclass__(cls) -> None:
        for name, default in cls.PROPERTIES.items():
            _add_property(cls, name, default)
        for name, port in cls.INPUT_NAMES.items():
            _add_input(cls, name, port)
        if cls.LIST:
            _add_list(cls, cls.LIST)
        if cls.SELECTIONS:
            cls.GetPointDataArraySelection = lambda self: self._selections["Point"]
            cls.GetCellDataArraySelection = lambda self: self._selections["Cell"]

    def __init__(self) -> None:
        super().__init__(nInputPorts=len(self.INPUTS), nOutputPorts=len(self.OUTPUTS),
                         outputType=self.OUTPUTS[0])
        self._values = dict(self.PROPERTIES)
        self.texts: list[str] = []
        self._selections = {kind: vtkDataArraySelection() for kind in ("Point", "Cell")}
        for selection in self._selections.values():
            selection.AddObserver("ModifiedEvent", lambda *_: self.Modified())

    def FillInputPortInformation(self, port: int, info: Any) -> int:
        info.Set(vtkAlgorithm.INPUT_REQUIRED_DATA_TYPE(), self.INPUTS[port])
        if port in self.OPTIONAL_INPUTS:
            info.Set(vtkAlgorithm.INPUT_IS_OPTIONAL(), 1)
        return 1

    def FillOutputPortInformation(self, port: int, info: Any) -> int:
        info.Set(vtkDataObject.DATA_TYPE_NAME(), self.OUTPUTS[port])
        return 1

    def SetInputData(self, *port_and_data: Any) -> None:
        """Sets the data of a port, by default of the first one."""
        *port, data = port_and_data
        self.SetInputDataObject(port[0] if port else 0, data)

    def GetOutput(self, port: int = 0) -> Any:
        return self.GetOutputDataObject(port)

    def RequestData(self, _request: Any, inputs: Any, outputs: Any) -> int:
        return self.guarded(lambda: self.execute(inputs, outputs))

    def execute(self, inputs: Any, outputs: Any) -> None:
        raise NotImplementedError

    def value(self, name: str) -> Any:
        return self._values[name]

    def chosen(self, kind: str, mesh: Any) -> list[str]:
        """Returns the names of a mesh's arrays that are not disabled."""
        data = mesh.GetPointData() if kind == "Point" else mesh.GetCellData()
        arrays = [data.GetArray(i) for i in range(data.GetNumberOfArrays())]
        names = [array.GetName() for array in arrays if array is not None]
        selection = self._selections[kind]
        return [name for name in names
                if name and name != "vtkGhostType" and (not selection.ArrayExists(name) or selection.ArrayIsEnabled(name))]

    def progress(self, fraction: float) -> bool:
        self.UpdateProgress(fraction)
        return not self.GetAbortExecute()

    def guarded(self, work: Callable[[], None]) -> int:
        """Returns 1 if work() succeeds, else 0. Turns exceptions and warnings into VTK's errors and warnings."""
        try:
            with warnings.catch_warnings(record=True) as caught:
                warnings.simplefilter("always")
                work()
        except Exception as error:  # pylint: disable=broad-except
            if str(error) == STOPPED and self.GetAbortExecute():
                return 1
            self._report("ErrorEvent", str(error.args[0]) if error.args else type(error).__name__)
            return 0
        for warning in caught:
            self._report("WarningEvent", str(warning.message))
        return 1

    def _report(self, event: str, sentence: str) -> None:
        if self.HasObserver(event):
            self.InvokeEvent(event, sentence)
            return
        window = vtkOutputWindow.GetInstance()
        if event == "ErrorEvent":
            window.DisplayErrorText(f"ERROR: {type(self).__name__}: {sentence}\n")
        else:
            window.DisplayWarningText(f"Warning: {type(self).__name__}: {sentence}\n")


def _add_property(cls: type, name: str, default: Any) -> None:
    kind = type(default)
    low, high = cls.LIMITS.get(name, (None, None))

    def converted(values: tuple[Any, ...]) -> Any:
        if kind is tuple:
            values = tuple(values[0]) if len(values) == 1 else values
            if len(values) != len(default):
                raise TypeError(f"{name} has {len(values)} values; give {len(default)}.")
            return tuple(type(d)(v) for d, v in zip(default, values))
        if len(values) != 1:
            raise TypeError(f"{name} has {len(values)} values; give one.")
        value = "" if kind is str and values[0] is None else kind(values[0])
        if low is not None and value < low:
            return kind(low)
        return kind(high) if high is not None and value > high else value

    def set_value(self: Any, *values: Any) -> None:
        value = converted(values)
        if value != self._values[name]:
            self._values[name] = value
            self.Modified()

    def get_value(self: Any) -> Any:
        return self._values[name]

    set_value.__name__, get_value.__name__ = f"Set{name}", f"Get{name}"
    set_value.__doc__ = f"Sets {name}; the default is {default!r}."
    get_value.__doc__ = f"Returns {name}."
    setattr(cls, f"Set{name}", set_value)
    setattr(cls, f"Get{name}", get_value)
    if kind is bool:
        setattr(cls, f"{name}On", lambda self: set_value(self, True))
        setattr(cls, f"{name}Off", lambda self: set_value(self, False))


def _add_input(cls: type, name: str, port: int) -> None:
    setattr(cls, f"Set{name}Data", lambda self, data: self.SetInputDataObject(port, data))
    setattr(cls, f"Set{name}Connection", lambda self, output: self.SetInputConnection(port, output))
    setattr(cls, f"Get{name}", lambda self: (
        self.GetInputDataObject(port, 0) if self.GetNumberOfInputConnections(port) else None))


def _add_list(cls: type, name: str) -> None:
    def add(self: Any, text: str) -> None:
        if text:
            self.texts.append(str(text))
            self.Modified()

    def clear(self: Any) -> None:
        if self.texts:
            self.texts.clear()
            self.Modified()

    def set_one(self: Any, text: str) -> None:
        if self.texts != [text]:
            clear(self)
            add(self, text)

    def get(self: Any, index: int) -> Any:
        return self.texts[index] if 0 <= index < len(self.texts) else None

    for method, function in ((f"Add{name}", add), (f"Clear{name}s", clear), (f"Set{name}", set_one),
                             (f"Get{name}", get), (f"GetNumberOf{name}s", lambda self: len(self.texts))):
        setattr(cls, method, function)


def add_total(name: str, value: float, totals: Any) -> None:
    """Adds an array of one value to the field data."""
    array = vtkIdTypeArray() if isinstance(value, int) else vtkDoubleArray()
    array.SetName(name)
    array.InsertNextValue(value)
    totals.AddArray(array)
