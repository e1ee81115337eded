# SPDX-License-Identifier: BSD-3-Clause
"""Runs a program on its own virtual display. (xvfb-run -a may give two programs that start together the same one.)

Usage: display.py COMMAND [ARGUMENT...]     runs the command on such a display
"""
import contextlib
import fcntl
import os
import subprocess
import sys
import tempfile


@contextlib.contextmanager
def one_at_a_time():
    """Two servers that start together may use the same socket, so only one may start at a time."""
    with open(os.path.join(tempfile.gettempdir(), f"tipp-display-{os.getuid()}.lock"), "w", encoding="utf-8") as file:
        fcntl.flock(file, fcntl.LOCK_EX)
        yield


@contextlib.contextmanager
def virtual_display(size=(1280, 1024), frames=None):
    """The name of the display. If `frames` is a folder, Xvfb keeps the display's pixels there."""
    read_end, write_end = os.pipe()
    # Without -noreset, the server resets when its last program ends, and refuses other programs meanwhile.
    command = ["Xvfb", "-displayfd", str(write_end), "-nolisten", "tcp", "-noreset",
               "-screen", "0", f"{size[0]}x{size[1]}x24"]
    if frames:
        command += ["-fbdir", str(frames)]
    with one_at_a_time():
        server = subprocess.Popen(command, pass_fds=[write_end], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(write_end)
        with os.fdopen(read_end) as answer:
            number = answer.readline().strip()  # empty if the server has ended
    try:
        if not number:
            raise RuntimeError("Xvfb did not start.")
        yield ":" + number
    finally:
        with one_at_a_time():
            server.terminate()
            server.wait()


if __name__ == "__main__":
    with virtual_display() as name:
        sys.exit(subprocess.run(sys.argv[1:], env={**os.environ, "DISPLAY": name}).returncode)
