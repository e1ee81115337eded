# SPDX-License-Identifier: BSD-3-Clause
"""A virtual display of one's own. (xvfb-run -a may give two programs that start together the same one.)

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
    """Servers that start together may take each other's socket."""
    with open(os.path.join(tempfile.gettempdir(), f"tipp-display-{os.getuid()}.lock"), "w", encoding="utf-8") as file:
        fcntl.flock(file, fcntl.LOCK_EX)
        yield


@contextlib.contextmanager
def virtual_display(size=(1280, 1024), frames=None):
    """The display's name. Xvfb keeps what it shows in the folder `frames`, if there is one."""
    read_end, write_end = os.pipe()
    # A server that resets when its last program leaves refuses the next one meanwhile.
    command = ["Xvfb", "-displayfd", str(write_end), "-nolisten", "tcp", "-noreset",
               "-screen", "0", f"{size[0]}x{size[1]}x24"]
    if frames:
        command += ["-fbdir", str(frames)]
    with one_at_a_time():
        server = subprocess.Popen(command, pass_fds=[write_end], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(write_end)
        with os.fdopen(read_end) as answer:
            number = answer.readline().strip()  # empty if the server ended
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
