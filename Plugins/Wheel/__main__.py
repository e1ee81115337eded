# SPDX-License-Identifier: BSD-3-Clause
"""The command `tipp`, also `python -m tipp`."""
import os
import signal
import sys


def main() -> int:
    """Runs the command with the arguments of the process, and returns the exit code."""
    # As in a process without Python: Ctrl-C ends it before the tool handles it, and so does a pipe that nobody reads.
    for number in (signal.SIGINT, signal.SIGPIPE):
        signal.signal(number, signal.SIG_DFL)
    from ._core import run_tool

    code = run_tool([os.fsencode(word) for word in sys.argv[1:]])
    if getattr(sys.modules.get("tipp._netcdf_output"), "failed", []):
        os._exit(code)  # where a file could not be written, HDF5 crashes when it ends
    return code


if __name__ == "__main__":
    sys.exit(main())
