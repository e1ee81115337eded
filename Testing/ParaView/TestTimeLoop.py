# SPDX-License-Identifier: BSD-3-Clause
"""Examples/pvbatch/time_loop.py samples a simulation's data in memory at each time step."""
from run_paraview import Session, expect

session = Session(__doc__)
output = session.pvbatch(session.source / "Examples/pvbatch/time_loop.py", session.scratch, "3")
levels = [line.split(":")[1] for line in output.splitlines() if line.startswith("step ")]
expect(len(levels) == 3, "there were not three steps")
expect(len(set(levels)) == 3, "the steps sampled the same values")
pictures = [(session.scratch / f"level-{step}.png").read_bytes() for step in range(3)]
expect(len(set(pictures)) == 3, "the steps gave the same picture")
