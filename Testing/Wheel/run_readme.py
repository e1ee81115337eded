# SPDX-License-Identifier: BSD-3-Clause
"""Runs the commands of the README's first section in the environment of this Python, which has the wheel, and compares
what they print with the README."""
import os
import pathlib
import re
import subprocess
import sys
import tempfile

TOP = pathlib.Path(__file__).resolve().parents[2]


def main():
    text = (TOP / "README.md").read_text()
    section = text[text.index("## Install"):text.index("## From source")]
    commands = [line for block in re.findall(r"^```sh\n(.*?)^```$", section, re.M | re.S) for line in block.splitlines()]
    results = re.findall(r"^```text\n(.*?)^```$", section, re.M | re.S)
    if commands.pop(0) != "pip install tipp" or len(results) != 1:
        sys.exit("README.md does not begin with pip, or shows no result.")
    programs = str(pathlib.Path(sys.executable).parent)
    settings = {**os.environ, "PATH": f"{programs}{os.pathsep}{os.environ['PATH']}"}
    printed = ""
    with tempfile.TemporaryDirectory() as folder:
        (pathlib.Path(folder) / "Examples").symlink_to(TOP / "Examples")
        for command in commands:
            print(command, flush=True)
            done = subprocess.run(["sh", "-euc", command], cwd=folder, env=settings, stdout=subprocess.PIPE,
                                  stderr=subprocess.STDOUT, text=True)
            printed += done.stdout
            if done.returncode != 0:
                sys.exit(f"'{command}' ends with {done.returncode}:\n{done.stdout}")
    for line in results[0].splitlines():
        if re.sub(r", [0-9.]+ s, .*", "", line) in printed:  # without the time and the memory
            continue
        sys.exit(f"The README shows\n{line}\nbut the commands print\n{printed}")


if __name__ == "__main__":
    main()
