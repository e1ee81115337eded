# SPDX-License-Identifier: BSD-3-Clause
"""The base class of the wheel's VTK filters: properties, lists of texts, selections of arrays, errors."""
from __future__ import annotations

import re
import weakref
from typing import Any, Callable

from ._arguments import STOPPED
from ._engine import kept_warnings
from ._vtkmodules import (
    VTKPythonAlgorithmBase,
    vtkAlgorithm,
    vtkDataArraySelection,
    vtkDataObject,
    vtkDoubleArray,
    vtkIdTypeArray,
    vtkOutputWindow,
    vtkStringArray,
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
            for kind in ("Point", "Cell"):
                _add_selection(cls, kind)

    def __init__(self, **properties: Any) -> None:
        """Sets properties by their names in Python, such as alpha=0.02."""
        super().__init__(nInputPorts=len(self.INPUTS), nOutputPorts=len(self.OUTPUTS),
                         outputType=self.OUTPUTS[0])
        self._values = dict(self.PROPERTIES)
        self.texts: list[str] = []
        self._selections = {kind: vtkDataArraySelection() for kind in ("Point", "Cell")} if self.SELECTIONS else {}
        # An observer with a reference to this object would keep it forever.
        self._observed = observed = [weakref.ref(self)]
        for selection in self._selections.values():
            selection.AddObserver("ModifiedEvent", lambda *_: _modify(observed[0]()))
        self.prepare()
        self._is_made = True
        for name, value in properties.items():
            setattr(self, name, value)

    def prepare(self) -> None:
        """Sets the other attributes of a subclass."""

    def __setattr__(self, name: str, value: Any) -> None:
        if not name.startswith("_") and "_is_made" in self.__dict__ and not (
                name in self.__dict__ or hasattr(type(self), name)):
            raise AttributeError(f"{type(self).__name__} has no property '{name}'.")
        super().__setattr__(name, value)

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

    def show_progress(self, fraction: float) -> bool:
        self.UpdateProgress(fraction)
        return not self.GetAbortExecute()

    def guarded(self, work: Callable[[], None]) -> int:
        """Returns 1 if work() succeeds, else 0. Turns exceptions and the package's warnings into VTK's errors and
        warnings."""
        try:
            with kept_warnings() as sentences:
                work()
        except Exception as error:  # pylint: disable=broad-except
            if str(error) == STOPPED and self.GetAbortExecute():
                return 1
            self._report("ErrorEvent", str(error.args[0]) if error.args else type(error).__name__)
            return 0
        for sentence in sentences:
            self._report("WarningEvent", sentence)
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


def _modify(algorithm: Filter | None) -> None:
    if algorithm is not None:
        algorithm.Modified()


def _in_python(name: str) -> str:
    """Returns the name that VTK 9.4 and later give a property in Python: maximum_edge_length for MaximumEdgeLength."""
    return re.sub(r"(?<=[a-z0-9])(?=[A-Z])|(?<=[A-Z])(?=[A-Z][a-z])", "_", name).lower()


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
    setattr(cls, _in_python(name), property(get_value, set_value, doc=f"{name}; the default is {default!r}."))
    if kind is bool:
        setattr(cls, f"{name}On", lambda self: set_value(self, True))
        setattr(cls, f"{name}Off", lambda self: set_value(self, False))


def _add_selection(cls: type, kind: str) -> None:
    def get(self: Any) -> Any:
        self._observed[0] = weakref.ref(self)  # VTK may have made another Python object for the same algorithm
        return self._selections[kind]

    setattr(cls, f"Get{kind}DataArraySelection", get)
    setattr(cls, _in_python(f"{kind}DataArraySelection"), property(get))


def _add_input(cls: type, name: str, port: int) -> None:
    def set_data(self: Any, data: Any) -> None:
        self.SetInputDataObject(port, data)

    def set_connection(self: Any, output: Any) -> None:
        self.SetInputConnection(port, output)

    def get(self: Any) -> Any:
        return self.GetInputDataObject(port, 0) if self.GetNumberOfInputConnections(port) else None

    for method, function in ((f"Set{name}Data", set_data), (f"Set{name}Connection", set_connection), (f"Get{name}", get)):
        setattr(cls, method, function)
    setattr(cls, _in_python(name), property(get))
    setattr(cls, _in_python(name + "Data"), property(None, set_data))
    setattr(cls, _in_python(name + "Connection"), property(None, set_connection))


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


def add_total(name: str, value: float | str, totals: Any) -> None:
    """Adds an array of one value to the field data."""
    kind = vtkStringArray if isinstance(value, str) else vtkIdTypeArray if isinstance(value, int) else vtkDoubleArray
    array = kind()
    array.SetName(name)
    array.InsertNextValue(value)
    totals.AddArray(array)
