# SPDX-License-Identifier: BSD-3-Clause
"""A virtual display of one's own. (xvfb-run -a may give two programs that start together the same one.)"""
import contextlib
import os
import subprocess


@contextlib.contextmanager
def virtual_display(size=(1280, 1024), frames=None):
    """The display's name. Xvfb keeps what it shows in the folder `frames`, if there is one."""
    read_end, write_end = os.pipe()
    command = ["Xvfb", "-displayfd", str(write_end), "-nolisten", "tcp", "-screen", "0", f"{size[0]}x{size[1]}x24"]
    if frames:
        command += ["-fbdir", str(frames)]
    server = subprocess.Popen(command, pass_fds=[write_end], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    os.close(write_end)
    try:
        with os.fdopen(read_end) as answer:
            number = answer.readline().strip()  # empty if the server ended
        if not number:
            raise RuntimeError("Xvfb did not start.")
        yield ":" + number
    finally:
        server.terminate()
        server.wait()
