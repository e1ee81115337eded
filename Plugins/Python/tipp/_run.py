# SPDX-License-Identifier: BSD-3-Clause
"""Runs a VTK algorithm as a Python function: errors become exceptions, and Ctrl-C stops it."""
from __future__ import annotations

import contextlib
import re
import signal
import threading
import warnings
from typing import Any, Callable, Iterator, TYPE_CHECKING

from ._arguments import finish, Progress, STOPPED

if TYPE_CHECKING:
    from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm


def require(built: str) -> None:
    """Raises ImportError if vtkmodules is of another release than `built`."""
    try:
        from vtkmodules.vtkCommonCore import vtkVersion
    except ImportError as error:
        raise ImportError(f"tipp needs the Python modules of VTK {built}, which it was built with, "
                          f"but they cannot be imported ({error}).") from None
    found = vtkVersion.GetVTKVersion()
    if found.split(".")[:2] != built.split(".")[:2]:
        raise ImportError(f"tipp was built with VTK {built} and cannot be used beside VTK {found}, which Python finds; "
                          "remove that one from the path, or use the wheel of tipp, which works with any VTK.")


@contextlib.contextmanager
def _interruptible(algorithm: vtkAlgorithm) -> Iterator[None]:
    """A context in which Ctrl-C aborts the algorithm. KeyboardInterrupt is raised when the context ends.

    VTK terminates the program if KeyboardInterrupt reaches it from a callback, so our own handler catches the signal.
    Python runs signal handlers during Python callbacks, which progress events trigger often.
    """
    signals: list[int] = []

    def stop(number: int, _frame: Any) -> None:
        signals.append(number)
        algorithm.SetAbortExecute(1)

    former: Any = None
    if threading.current_thread() is threading.main_thread():
        former = signal.getsignal(signal.SIGINT)
        if callable(former) or former == signal.SIG_DFL:
            signal.signal(signal.SIGINT, stop)
    try:
        yield
    finally:
        if former is not None:
            signal.signal(signal.SIGINT, former)
        algorithm.SetAbortExecute(0)
    if signals:
        raise KeyboardInterrupt


@contextlib.contextmanager
def _observed(subject: Any, event: str, callback: Callable[..., None]) -> Iterator[None]:
    tag = subject.AddObserver(event, callback)
    try:
        yield
    finally:
        subject.RemoveObserver(tag)


def _first_sentence(text: str) -> str:
    """An error's message on one line, without VTK's source location and object addresses. The path of a temporary
    output file is replaced by that of the output."""
    text = re.sub(r"^\s*(ERROR|Warning|Generic Warning): In .*, line \d+\s*", "", text)
    text = re.sub(r"^\s*\w+ \((0x)?[0-9a-fA-F]+\): ", "", text)
    text = re.sub(r" ?\((0x[0-9a-fA-F]+|nil)\)", "", text)
    text = re.sub(r"(^|/)\.([^/]+?)\.tmp\.\w{6}(/[^:]*)?", r"\1\2", text)
    text = re.sub(r" for request: vtkInformation\b.*", ".", text, flags=re.DOTALL)
    return " ".join(text.split())


def run(algorithm: vtkAlgorithm, progress: Progress | None = None, call: Callable[[], Any] | None = None) -> Any:
    """Updates the algorithm, or runs `call`. Errors become a RuntimeError, warnings Python warnings."""
    errors: list[str] = []
    notes: list[str] = []

    def on_error(_object: Any, _event: str, text: str) -> None:
        errors.append(_first_sentence(text))

    def on_warning(_object: Any, _event: str, text: str) -> None:
        notes.append(_first_sentence(text))

    raised: list[BaseException] = []

    def on_progress(_object: Any, _event: str) -> None:
        if progress is None or raised or algorithm.GetAbortExecute():  # VTK 9.3 ends an aborted run with 1.0
            return
        try:  # VTK ends the program on an exception in a callback
            stopped = progress(algorithm.GetProgress()) is False
        except BaseException as error:  # pylint: disable=broad-except
            raised.append(error)
        else:
            if stopped:
                raised.append(RuntimeError(STOPPED))
        if raised:
            algorithm.SetAbortExecute(1)

    on_error.CallDataType = on_warning.CallDataType = "string0"  # type: ignore[attr-defined]
    with contextlib.ExitStack() as stack:
        for subject in (algorithm, algorithm.GetExecutive()):
            stack.enter_context(_observed(subject, "ErrorEvent", on_error))
            stack.enter_context(_observed(subject, "WarningEvent", on_warning))
        stack.enter_context(_observed(algorithm, "ProgressEvent", on_progress))
        stack.enter_context(_interruptible(algorithm))
        result = call() if call else algorithm.Update()
    finish(progress)
    if raised:
        raise raised[0]
    for note in notes:
        warnings.warn(note, RuntimeWarning, stacklevel=3)
    if errors:
        raise RuntimeError(errors[0])
    return result
